#include "apps/output/pictures/projection.h"

#include "apps/output/pictures/painting_order.h"
#include "apps/output/text/svg.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace gestell::apps
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double fineness      = 2.; ///< points of the depth raster per unit
constexpr double coarse_facet  = 7.; ///< longest edge [units]: larger ones that cross each other are parted
constexpr double n_scale_steps = 24., n_light_steps = 12.;

/// Twice the area of the triangle a, b, c in the picture, positive if clockwise as seen.
double cross(const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Vector3d on_raster(const Vector3d &x)
{
  return {fineness * x[0], fineness * x[1], x[2]};
}

double in_steps(double s, double n)
{
  return std::round(n * s) / n;
}

double longest_edge(const Facet &facet)
{
  const auto &[a, b, c] = facet.corners;
  return std::max({(b - a).head<2>().norm(), (c - b).head<2>().norm(), (a - c).head<2>().norm()});
}

void add_quarters(const Facet &facet, std::vector<Facet> &facets)
{
  const auto &[a, b, c] = facet.corners;
  const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  for (const std::array<Vector3d, 3> &corners : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
    facets.push_back({corners, facet.colour, facet.face});
}

/// The path of one facet in half units, relative, as short as can be.
std::string triangle_path(const Facet &facet)
{
  std::string         svg;
  std::array<long, 2> previous = {0, 0};
  for (int i = 0; i < 3; ++i)
  {
    const std::array<long, 2> place = {std::lround(2. * facet.corners[i][0]), std::lround(2. * facet.corners[i][1])};
    const std::string         x = std::to_string(place[0] - previous[0]), y = std::to_string(place[1] - previous[1]);
    const char *const         before = i == 0 ? "M" : i == 1 ? "l" : x[0] == '-' ? "" : " ";
    svg += before + x + (y[0] == '-' ? "" : " ") + y;
    previous = place;
  }
  return svg + 'z';
}

} // namespace

View::View(const std::vector<Vector3d> &seen, double picture_size, const ViewPoint &from)
{
  towards_ = from.towards.normalized();
  right_   = from.upwards.cross(towards_).normalized();
  up_      = towards_.cross(right_);
  low_     = Vector2d::Constant(1e300);
  high_    = -low_;
  for (const Vector3d &x : seen)
  {
    const Vector2d flat(right_.dot(x), up_.dot(x));
    low_  = low_.cwiseMin(flat);
    high_ = high_.cwiseMax(flat);
  }
  scale_ = picture_size / std::max((high_ - low_).maxCoeff(), 1e-12);
}

Vector3d View::operator()(const Vector3d &x) const
{
  return {scale_ * (right_.dot(x) - low_[0]), scale_ * (high_[1] - up_.dot(x)), scale_ * towards_.dot(x)};
}

double View::width() const
{
  return scale_ * (high_[0] - low_[0]);
}

double View::height() const
{
  return scale_ * (high_[1] - low_[1]);
}

double View::light_on(const Vector3d &normal) const
{
  const Vector3d lamp = (towards_ + 0.6 * up_ + 0.5 * right_).normalized();
  return 0.62 + 0.42 * in_steps(std::max(0., normal.dot(lamp)), n_light_steps);
}

DepthRaster::DepthRaster(const std::vector<Facet> &facets, const View &view)
    : DepthRaster(facets, static_cast<int>(fineness * view.width()) + 2, static_cast<int>(fineness * view.height()) + 2)
{
}

DepthRaster::DepthRaster(const std::vector<Facet> &facets, int columns, int rows)
    : columns_(columns), rows_(rows), depth_(static_cast<std::size_t>(columns_) * rows_, -1e300),
      facet_(depth_.size(), -1)
{
  for (std::size_t i = 0; i < facets.size(); ++i)
    for_each_point(facets[i].corners,
                   [&](int column, int row, double depth)
                   {
                     const std::size_t point = index(column, row);
                     if (depth <= depth_[point])
                       return;
                     depth_[point] = depth;
                     facet_[point] = static_cast<int>(i);
                   });
}

template <typename Visit>
void DepthRaster::for_each_point(const std::array<Vector3d, 3> &corners, const Visit &visit) const
{
  const Vector3d a = on_raster(corners[0]), b = on_raster(corners[1]), c = on_raster(corners[2]);
  const double   area = cross(a, b, c);
  if (std::abs(area) < 1e-12)
    return;
  const auto bound = [](double x, int n) { return std::clamp(static_cast<int>(x), 0, n - 1); };
  const int  left = bound(std::min({a[0], b[0], c[0]}), columns_), top = bound(std::min({a[1], b[1], c[1]}), rows_);
  const int  right  = bound(std::max({a[0], b[0], c[0]}) + 1., columns_);
  const int  bottom = bound(std::max({a[1], b[1], c[1]}) + 1., rows_);
  for (int j = top; j <= bottom; ++j)
    for (int i = left; i <= right; ++i)
    {
      // Shares of the corners in the raster point.
      const Vector3d x(i, j, 0.);
      const double   u = cross(x, b, c) / area, v = cross(a, x, c) / area, w = 1. - u - v;
      if (std::min({u, v, w}) >= -1e-9)
        visit(i, j, u * a[2] + v * b[2] + w * c[2]);
    }
}

bool DepthRaster::sees(const Vector3d &x, double slack) const
{
  const int i = std::clamp(static_cast<int>(std::lround(fineness * x[0])), 0, columns_ - 1);
  const int j = std::clamp(static_cast<int>(std::lround(fineness * x[1])), 0, rows_ - 1);
  return x[2] + slack >= depth_[index(i, j)];
}

HidingCounts DepthRaster::hiding(const std::vector<Facet> &facets, const std::vector<int> &seen) const
{
  constexpr double touching = 1e-3; // [units] of depth: neighbours at their common edge
  constexpr double apart    = 1.;   // those that do not meet at the next point either
  HidingCounts     pairs;
  for (const int facet : seen)
  {
    std::map<int, int> before; // those that hide it, and at how many points
    for_each_point(facets[std::size_t(facet)].corners,
                   [&](int i, int j, double depth)
                   {
                     const std::size_t point = index(i, j);
                     if (facet_[point] == facet || depth >= depth_[point] - touching)
                       return;
                     ++before[facet_[point]];
                     // What is around hides the breadth of its line.
                     for (const auto &[k, l] : {std::pair(i - 1, j), {i + 1, j}, {i, j - 1}, {i, j + 1}})
                     {
                       if (k < 0 || k >= columns_ || l < 0 || l >= rows_)
                         continue;
                       const std::size_t next = index(k, l);
                       if (facet_[next] >= 0 && facet_[next] != facet && depth < depth_[next] - apart)
                         ++before[facet_[next]];
                     }
                   });
    for (const auto &[front, count] : before)
      pairs.push_back({facet, front, count});
  }
  return pairs;
}

std::vector<Facet> DepthRaster::visible(const std::vector<Facet> &facets) const
{
  std::vector<bool> is_seen(facets.size(), false);
  for (const int facet : facet_)
    if (facet >= 0)
      is_seen[std::size_t(facet)] = true;
  std::vector<int> seen;
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (is_seen[i])
      seen.push_back(int(i));
  const PaintingOrder order = painting_order(facets, seen, hiding(facets, seen));

  const std::set<int> ring(order.ring.begin(), order.ring.end());
  std::vector<Facet>  painted;
  for (const int facet : order.facets)
    if (ring.count(facet) > 0 && longest_edge(facets[facet]) > coarse_facet)
      add_quarters(facets[facet], painted);
    else
      painted.push_back(facets[facet]);
  return painted.size() > order.facets.size() ? DepthRaster(painted, columns_, rows_).visible(painted) : painted;
}

Colour scale_colour(double s)
{
  static const std::array<Colour, 5> stops = {
      {{64, 67, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double place = 4. * in_steps(std::clamp(s, 0., 1.), n_scale_steps);
  const int    i     = std::min(static_cast<int>(place), 3);
  Colour       mixed;
  for (int k = 0; k < 3; ++k)
    mixed[k] = stops[i][k] + (place - i) * (stops[i + 1][k] - stops[i][k]);
  return mixed;
}

std::string hex(const Colour &colour, double light)
{
  const auto part = [&](int k) { return std::clamp(static_cast<int>(light * colour[k]), 0, 255); };
  char       text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(0), part(1), part(2));
  return text;
}

std::string facet_paths(const std::vector<Facet> &facets)
{
  const auto   look = [](const Facet &facet) { return std::tie(facet.face, facet.colour); };
  std::string  svg  = "<g transform=\"scale(.5)\">";
  const Facet *open = nullptr;
  for (const Facet &facet : facets)
  {
    if (open == nullptr || look(*open) != look(facet))
      svg += (open != nullptr ? "\"/><path " : "<path ") +
             (facet.face >= 0 ? "data-f=\"" + std::to_string(facet.face) + "\" " : "") + "color=\"" + facet.colour +
             "\" d=\"";
    open = &facet;
    svg += triangle_path(facet);
  }
  return svg + (open != nullptr ? "\"/></g>" : "</g>");
}

std::string edge_lines(const std::vector<std::array<int, 2>> &edges, const std::vector<Vector3d> &points,
                       const View &view, const DepthRaster *raster)
{
  constexpr double slack = 2.5; // [units] by which the raster rounds
  constexpr double piece = 5.;  // [units] of an edge that is seen or not
  std::string      svg;
  const auto       add = [&](const Vector3d &from, const Vector3d &to)
  {
    append_coordinate(svg += 'M', from[0]);
    append_coordinate(svg += ' ', from[1]);
    append_coordinate(svg += 'L', to[0]);
    append_coordinate(svg += ' ', to[1]);
  };
  for (const auto &[a, b] : edges)
  {
    const Vector3d p = view(points[a]), q = view(points[b]);
    const int      n     = raster == nullptr ? 1 : std::max(1, static_cast<int>((q - p).head<2>().norm() / piece));
    const auto     at    = [&](double i) -> Vector3d { return p + i / n * (q - p); };
    int            begin = 0; // of what is seen
    for (int i = 0; i <= n; ++i)
      if (i == n || (raster != nullptr && !raster->sees(at(i + 0.5), slack)))
      {
        if (i > begin)
          add(at(begin), at(i));
        begin = i + 1;
      }
  }
  return svg;
}

} // namespace gestell::apps
