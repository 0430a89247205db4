#include "apps/output/pictures/projection.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <optional>

using namespace gestell::apps;
using Eigen::Vector3d;

namespace
{

struct Box
{
  Vector3d low, high;
};

/// Bars that lie across each other, a wall on one of them: the middles of their faces are far from their edges.
const std::vector<Box> boxes = {{{0., 0., 0.}, {2., 0.2, 0.2}},
                                {{0.3, -1., 0.2}, {0.5, 2., 0.4}},
                                {{1.5, -0.3, 0.2}, {1.7, 0.5, 1.7}},
                                {{0.3, 1.7, 0.4}, {1.9, 1.9, 0.6}}};

const ViewPoint views[] = {{},
                           {{-0.55, 0.75, -0.36}, Vector3d::UnitZ()},
                           {{-1., 0., 0.}, Vector3d::UnitZ()},
                           {{0.2, 0.9, 0.1}, Vector3d::UnitZ()},
                           {{0., 0., -1.}, Vector3d::UnitY()}};

struct Drawing
{
  std::vector<Vector3d> points;
  std::vector<Facet>    facets; ///< two to each side of a box that faces the viewer
};

Drawing drawing_of(const std::vector<Box> &drawn, const ViewPoint &from)
{
  Drawing drawing;
  for (const Box &box : drawn)
    for (int corner = 0; corner < 8; ++corner)
      drawing.points.emplace_back((corner & 1 ? box.high : box.low)[0], (corner & 2 ? box.high : box.low)[1],
                                  (corner & 4 ? box.high : box.low)[2]);
  const View view(drawing.points, 300., from);
  for (std::size_t b = 0; b < drawn.size(); ++b)
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true})
      {
        const Vector3d normal = (high ? 1. : -1.) * Vector3d::Unit(axis);
        if (!view.faces_viewer(normal))
          continue;
        std::array<Vector3d, 4> corners;
        for (int k = 0; k < 4; ++k)
        {
          Vector3d x;
          x[axis]           = (high ? drawn[b].high : drawn[b].low)[axis];
          x[(axis + 1) % 3] = (k == 1 || k == 2 ? drawn[b].high : drawn[b].low)[(axis + 1) % 3];
          x[(axis + 2) % 3] = (k >= 2 ? drawn[b].high : drawn[b].low)[(axis + 2) % 3];
          corners[k]        = view(x);
        }
        const std::string colour = axis == 0 ? "#800000" : axis == 1 ? "#008000" : "#000080";
        drawing.facets.push_back({{corners[0], corners[1], corners[2]}, colour, -1});
        drawing.facets.push_back({{corners[0], corners[2], corners[3]}, colour, -1});
      }
  return drawing;
}

/// Depth of a facet at a place in the picture.
std::optional<double> depth_at(const Facet &facet, const Eigen::Vector2d &x)
{
  const auto &[a, b, c] = facet.corners;
  Eigen::Matrix3d shares;
  shares << a[0], b[0], c[0], a[1], b[1], c[1], 1., 1., 1.;
  if (std::abs(shares.determinant()) < 1e-9)
    return std::nullopt;
  const Vector3d share = shares.inverse() * Vector3d(x[0], x[1], 1.);
  if (share.minCoeff() < 0.)
    return std::nullopt;
  return share.dot(Vector3d(a[2], b[2], c[2]));
}

/// Of the facets at a place: how many, and whether another than the nearest is painted last.
std::pair<int, bool> painted_at(const std::vector<Facet> &painted, const Eigen::Vector2d &x)
{
  double on_top = -1e300, nearest = -1e300;
  int    n = 0;
  for (const Facet &facet : painted)
    if (const auto depth = depth_at(facet, x))
    {
      on_top  = *depth;
      nearest = std::max(nearest, *depth);
      ++n;
    }
  return {n, on_top < nearest - 1e-3};
}

/// Places where another than the nearest facet is painted last, wherever that is wider than the raster of depths.
/// @param n_hiding  places where several facets lie
int n_wrong(const std::vector<Facet> &painted, const View &view, int *n_hiding = nullptr)
{
  int wrong = 0;
  for (double x = 0.3; x < view.width(); x += 2.)
    for (double y = 0.3; y < view.height(); y += 2.)
    {
      const auto [n, lies] = painted_at(painted, {x, y});
      bool around          = lies;
      for (const double dx : {-0.5, 0.5})
        for (const double dy : {-0.5, 0.5})
          around = around && painted_at(painted, {x + dx, y + dy}).second;
      wrong += around;
      if (n_hiding != nullptr)
        *n_hiding += n > 1;
    }
  return wrong;
}

} // namespace

TEST(PaintingOrder, LeavesTheNearestOnTopHoweverLargeTheTrianglesAre)
{
  for (const ViewPoint &from : views)
  {
    const Drawing            drawing = drawing_of(boxes, from);
    const View               view(drawing.points, 300., from);
    const std::vector<Facet> painted  = DepthRaster(drawing.facets, view).visible(drawing.facets);
    int                      n_hiding = 0;
    EXPECT_EQ(n_wrong(painted, view, &n_hiding), 0) << from.towards.transpose();
    EXPECT_GT(n_hiding, 100);
  }
}

TEST(PaintingOrder, PaintsAllThatIsSeenOfTrianglesThatHideEachOtherInARing)
{
  // Three long triangles, the blunt end of each over the tip of the next.
  std::vector<Vector3d> points;
  for (const double angle : {0., 2. * M_PI / 3., 4. * M_PI / 3.})
    for (const Vector3d &x : {Vector3d(-1., -0.6, 0.2), Vector3d(1., -0.45, -0.2), Vector3d(-1., -0.3, 0.2)})
      points.push_back(Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * x);
  const View         view(points, 120., {Vector3d::UnitZ(), Vector3d::UnitY()});
  std::vector<Facet> facets;
  for (int k = 0; k < 9; k += 3)
    facets.push_back({{view(points[k]), view(points[k + 1]), view(points[k + 2])}, "#00000" + std::to_string(k), -1});
  const std::vector<Facet> painted = DepthRaster(facets, view).visible(facets);
  EXPECT_GT(painted.size(), 3u); // in parts
  EXPECT_EQ(n_wrong(painted, view), 0);
}

TEST(PaintingOrder, KeepsOneColourTogetherWhereItMay)
{
  const Drawing            drawing = drawing_of({{{0., 0., 0.}, {1., 1., 1.}}, {{3., 0., 0.}, {4., 1., 1.}}}, views[0]);
  const View               view(drawing.points, 300.);
  const std::vector<Facet> painted = DepthRaster(drawing.facets, view).visible(drawing.facets);
  const std::string        paths   = facet_paths(painted);
  std::size_t              n       = 0;
  for (std::size_t at = paths.find("<path"); at != std::string::npos; at = paths.find("<path", at + 1))
    ++n;
  EXPECT_EQ(n, 3u); // colours of two boxes beside each other
}
