#include "fem/mesh/plates/section_mesh.h"

#include "fem/mesh/gmsh_elements.h"

#include <gmsh.h>

#include <algorithm>
#include <map>
#include <string>

namespace gestell::fem
{

namespace
{

constexpr double frontal_delaunay = 6.; // number of gmsh; that of quadrilaterals, 8, crashes in 4.8

/// A model of gmsh beside the one that is current, for as long as this lives.
class ModelAside
{
public:
  ModelAside()
  {
    gmsh::model::getCurrent(before_);
    gmsh::option::getNumber("Mesh.Algorithm", algorithm_);
    gmsh::model::add("section of a plate");
    gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay);
  }
  ~ModelAside()
  {
    gmsh::model::remove();
    gmsh::option::setNumber("Mesh.Algorithm", algorithm_);
    gmsh::model::setCurrent(before_);
  }
  ModelAside(const ModelAside &)            = delete;
  ModelAside &operator=(const ModelAside &) = delete;

private:
  std::string before_;
  double      algorithm_ = 0.;
};

/// Lengths are measured in the extent of the outline, as gmsh's tolerances are absolute.
class Drawing
{
public:
  Drawing(const std::vector<Point2> &outline) : origin_(outline.front())
  {
    for (const Point2 &x : outline)
      scale_ = std::max({scale_, std::abs(x[0] - origin_[0]), std::abs(x[1] - origin_[1])});
  }

  /// @return tag of the loop
  int draw(const std::vector<Point2> &loop)
  {
    namespace geo = gmsh::model::geo;
    std::vector<int> points, lines;
    for (const Point2 &x : loop)
    {
      points.push_back(geo::addPoint((x[0] - origin_[0]) / scale_, (x[1] - origin_[1]) / scale_, 0.));
      given_.push_back(x);
      point_.push_back(points.back());
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      lines.push_back(geo::addLine(points[i], points[(i + 1) % points.size()]));
    for (const int line : lines)
      geo::mesh::setTransfiniteCurve(line, 2);
    return geo::addCurveLoop(lines);
  }

  SectionMesh meshed(int surface)
  {
    SectionMesh                result;
    std::map<std::size_t, int> index; // of gmsh's nodes
    result.points = given_;
    for (std::size_t i = 0; i < point_.size(); ++i)
    {
      std::vector<std::size_t> tags;
      std::vector<double>      x, u;
      gmsh::model::mesh::getNodes(tags, x, u, 0, point_[i]);
      index[tags.at(0)] = static_cast<int>(i);
    }
    std::vector<std::size_t> tags;
    std::vector<double>      x, u;
    gmsh::model::mesh::getNodes(tags, x, u, 2, surface);
    for (std::size_t i = 0; i < tags.size(); ++i)
    {
      index[tags[i]] = static_cast<int>(result.points.size());
      result.points.push_back({origin_[0] + scale_ * x[3 * i], origin_[1] + scale_ * x[3 * i + 1]});
    }
    for (const GmshElements &elements : elements_of(2, surface))
      for (std::size_t j = 0; j < elements.nodes.size(); j += static_cast<std::size_t>(elements.n_nodes))
      {
        std::vector<int> corners;
        for (int k = 0; k < elements.n_corners; ++k)
          corners.push_back(index.at(elements.nodes[j + k]));
        if (area(result, corners) < 0.)
          std::reverse(corners.begin(), corners.end());
        if (corners.size() == 4)
          result.quadrilaterals.push_back({corners[0], corners[1], corners[2], corners[3]});
        else
          result.triangles.push_back({corners[0], corners[1], corners[2]});
      }
    return result;
  }

private:
  static double area(const SectionMesh &mesh, const std::vector<int> &corners)
  {
    double twice = 0.;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const Point2 &a = mesh.points[corners[i]], &b = mesh.points[corners[(i + 1) % corners.size()]];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * twice;
  }

  Point2              origin_;
  double              scale_ = 0.;
  std::vector<Point2> given_;
  std::vector<int>    point_; // gmsh's tags
};

} // namespace

SectionMesh section_mesh(const std::vector<Point2> &outline, const std::vector<std::vector<Point2>> &holes)
{
  const ModelAside aside;
  Drawing          drawing(outline);
  std::vector<int> loops = {drawing.draw(outline)};
  for (const std::vector<Point2> &hole : holes)
    loops.push_back(drawing.draw(hole));
  const int surface = gmsh::model::geo::addPlaneSurface(loops);
  gmsh::model::geo::mesh::setRecombine(2, surface);
  gmsh::model::geo::synchronize();
  try
  {
    gmsh::model::mesh::generate(2);
    return drawing.meshed(surface);
  }
  catch (const std::exception &error)
  {
    throw NotSwept("gmsh cannot mesh the section of a plate around a hole: " + std::string(error.what()));
  }
}

} // namespace gestell::fem
