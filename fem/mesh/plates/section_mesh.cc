#include "fem/mesh/plates/section_mesh.h"

#include "fem/mesh/gmsh_elements.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace gestell::fem
{

namespace
{

/// A second model of gmsh for the lifetime of this object; the current model is restored after it.  The sides of the
/// drawing determine the size of its cells.
class ModelAside
{
public:
  ModelAside()
  {
    gmsh::model::getCurrent(before_);
    gmsh::option::getNumber("Mesh.Algorithm", algorithm_);
    gmsh::option::getNumber("Mesh.MeshSizeMax", size_);
    gmsh::model::add("section of a plate");
    constexpr double frontal_delaunay = 6.;   // number of gmsh; 8, for quadrilaterals, crashes in 4.8
    constexpr double no_limit         = 1e22; // of gmsh
    gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay);
    gmsh::option::setNumber("Mesh.MeshSizeMax", no_limit);
  }
  ~ModelAside()
  {
    gmsh::model::remove();
    gmsh::option::setNumber("Mesh.Algorithm", algorithm_);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size_);
    gmsh::model::setCurrent(before_);
  }
  ModelAside(const ModelAside &)            = delete;
  ModelAside &operator=(const ModelAside &) = delete;

private:
  std::string before_;
  double      algorithm_ = 0., size_ = 0.;
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
    const auto       first = static_cast<int>(given_.size());
    const auto       n     = static_cast<int>(loop.size() / 2);
    for (int i = 0; i < n; ++i)
    {
      const Point2 &x = loop[2 * i];
      points.push_back(geo::addPoint((x[0] - origin_[0]) / scale_, (x[1] - origin_[1]) / scale_, 0.));
      given_.push_back(x);
      point_.push_back(points.back());
      between_[std::minmax(first + i, first + (i + 1) % n)] = loop[2 * i + 1];
    }
    for (int i = 0; i < n; ++i)
      lines.push_back(geo::addLine(points[i], points[(i + 1) % n]));
    for (const int line : lines)
      geo::mesh::setTransfiniteCurve(line, 2);
    return geo::addCurveLoop(lines);
  }

  SectionMesh meshed(const std::vector<int> &surfaces)
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
    for (const int surface : surfaces)
      add_points(surface, index, result);
    for (const int surface : surfaces)
      for (const GmshElements &elements : elements_of(2, surface))
        for (std::size_t j = 0; j < elements.nodes.size(); j += static_cast<std::size_t>(elements.n_nodes))
        {
          std::vector<int> corners;
          for (int k = 0; k < elements.n_corners; ++k)
            corners.push_back(index.at(elements.nodes[j + k]));
          if (area(result, corners) < 0.)
            std::reverse(corners.begin(), corners.end());
          divide(corners, result);
        }
    return result;
  }

private:
  void add_points(int surface, std::map<std::size_t, int> &index, SectionMesh &mesh) const
  {
    std::vector<std::size_t> tags;
    std::vector<double>      x, u;
    gmsh::model::mesh::getNodes(tags, x, u, 2, surface);
    for (std::size_t i = 0; i < tags.size(); ++i)
    {
      index[tags[i]] = static_cast<int>(mesh.points.size());
      mesh.points.push_back({origin_[0] + scale_ * x[3 * i], origin_[1] + scale_ * x[3 * i + 1]});
    }
  }

  /// A cell of n corners into n quadrilaterals about its middle.
  void divide(const std::vector<int> &corners, SectionMesh &mesh)
  {
    const std::size_t n = corners.size();
    Point2            middle{};
    for (const int corner : corners)
      for (int k = 0; k < 2; ++k)
        middle[k] += mesh.points[corner][k] / double(n);
    const auto centre = static_cast<int>(mesh.points.size());
    mesh.points.push_back(middle);
    for (std::size_t i = 0; i < n; ++i)
      mesh.quadrilaterals.push_back({corners[i], amid(corners[i], corners[(i + 1) % n], mesh), centre,
                                     amid(corners[(i + n - 1) % n], corners[i], mesh)});
  }

  int amid(int a, int b, SectionMesh &mesh)
  {
    const auto key             = std::pair<int, int>(std::minmax(a, b));
    const auto [entry, is_new] = amid_.try_emplace(key, static_cast<int>(mesh.points.size()));
    if (is_new)
    {
      const auto    given = between_.find(key);
      const Point2 &p = mesh.points[a], &q = mesh.points[b];
      mesh.points.push_back(given != between_.end() ? given->second : Point2{0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])});
    }
    return entry->second;
  }

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

  Point2                                origin_;
  double                                scale_ = 0.;
  std::vector<Point2>                   given_;
  std::vector<int>                      point_;   // gmsh's tags
  std::map<std::pair<int, int>, Point2> between_; // points given in the middle of two others
  std::map<std::pair<int, int>, int>    amid_;    // points in the middle of two others
};

std::vector<Side> sides_of(const std::vector<Point2> &points)
{
  std::vector<Side> sides;
  for (std::size_t i = 0; i < points.size(); ++i)
    sides.push_back({points[i], points[(i + 1) % points.size()]});
  return sides;
}

/// For each line the one that is directly around it, -1 for the outline.
std::vector<int> around(const std::vector<InnerLine> &lines)
{
  std::vector<std::vector<int>> outside(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < lines.size(); ++j)
      if (i != j && is_inside(sides_of(lines[j].points), lines[i].points.front()))
        outside[i].push_back(static_cast<int>(j));
  std::vector<int> result;
  for (const std::vector<int> &all : outside) // the one that most others are around
    result.push_back(all.empty()
                         ? -1
                         : *std::max_element(all.begin(), all.end(),
                                             [&](int a, int b) { return outside[a].size() < outside[b].size(); }));
  return result;
}

} // namespace

SectionMesh section_mesh(const std::vector<Point2> &outline, const std::vector<InnerLine> &lines)
{
  const ModelAside              aside;
  Drawing                       drawing(outline);
  std::vector<std::vector<int>> loops = {{drawing.draw(outline)}}; // of the outline's area, then of that in each line
  for (const InnerLine &line : lines)
    loops.push_back({drawing.draw(line.points)});
  const std::vector<int> beyond = around(lines);
  for (std::size_t i = 0; i < lines.size(); ++i)
    loops[beyond[i] + 1].push_back(loops[i + 1].front());
  std::vector<int> surfaces;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (i == 0 || lines[i - 1].filled)
    {
      surfaces.push_back(gmsh::model::geo::addPlaneSurface(loops[i]));
      gmsh::model::geo::mesh::setRecombine(2, surfaces.back());
    }
  gmsh::model::geo::synchronize();
  try
  {
    gmsh::model::mesh::generate(2);
    return drawing.meshed(surfaces);
  }
  catch (const std::exception &error)
  {
    throw NotSwept("gmsh cannot mesh the section of a plate around a hole: " + std::string(error.what()));
  }
}

} // namespace gestell::fem
