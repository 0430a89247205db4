#include "fem/mesh/mesh_grading.h"

#include "fem/values/two_pi.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace gestell::fem
{

namespace
{

/// Distance of a point from a box, a lower bound of the distance from its contents.
double distance(const Vector3 &x, const Vector3 &min, const Vector3 &max)
{
  Vector3 apart{};
  for (int d = 0; d < 3; ++d)
    apart[d] = std::max({0., min[d] - x[d], x[d] - max[d]});
  return norm(apart);
}

/// [m]
std::unordered_map<std::size_t, Vector3> points_of_mesh(double unit)
{
  std::vector<std::size_t> tags;
  std::vector<double>      x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
  std::unordered_map<std::size_t, Vector3> points;
  for (std::size_t i = 0; i < tags.size(); ++i)
    points[tags[i]] = unit * Vector3{x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  return points;
}

std::vector<std::size_t> nodes_of(int type, int tag)
{
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(type, elements, nodes, tag);
  return nodes;
}

struct MeshedEdge
{
  int     tag;
  int     n_sides;
  double  side; ///< [m] mean length
  Vector3 at;   ///< middle of its box
};

std::vector<MeshedEdge> edges_of_mesh(double unit)
{
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  std::vector<MeshedEdge> edges;
  for (const auto &[dim, tag] : curves)
  {
    double length = 0.;
    gmsh::model::occ::getMass(1, tag, length);
    Vector3 low, high;
    gmsh::model::getBoundingBox(1, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    constexpr int line = 1; // gmsh's types of elements
    if (const int n = static_cast<int>(nodes_of(line, tag).size() / 2); n > 0)
      edges.push_back({tag, n, unit * length / n, (0.5 * unit) * (low + high)});
  }
  return edges;
}

/// A field that is s at the curves and grows up to h with the distance, in gmsh's unit.
int add_field(const std::vector<double> &curves, int n_points, double s, double h)
{
  namespace field    = gmsh::model::mesh::field;
  const int distance = field::add("Distance");
  field::setNumbers(distance, "EdgesList", curves);
  field::setNumber(distance, "NNodesByEdge", n_points);
  const int threshold = field::add("Threshold");
  field::setNumber(threshold, "InField", distance);
  field::setNumber(threshold, "SizeMin", s);
  field::setNumber(threshold, "SizeMax", h);
  field::setNumber(threshold, "DistMin", s);
  field::setNumber(threshold, "DistMax", s + (h - s) / size_growth);
  return threshold;
}

} // namespace

WantedSize::WantedSize(const CadModel &model, const MeshOptions &options, const Selection &selection,
                       const std::optional<SizeField> &refined, const FaceSizes &walls)
    : size_(options.size), refined_(refined)
{
  const auto sizes = resolve_surface_sizes(options, selection);
  for (const Face &face : model.faces)
  {
    for (const auto &[name, size] : sizes)
      if (const auto &tags = selection.at(name); std::find(tags.begin(), tags.end(), face.tag) != tags.end())
        surfaces_.push_back({face.min, face.max, size});
    if (const auto wall = walls.find(face.tag); wall != walls.end())
      surfaces_.push_back({face.min, face.max, model.unit * wall->second});
    if (face.kind == FaceKind::cylinder)
      bores_.push_back({face.min, face.max, two_pi * face.radius / elements_around_circle});
  }
}

double WantedSize::near(const std::vector<Region> &regions, const Vector3 &x, double size)
{
  for (const Region &region : regions)
    size = std::min(size, region.size + size_growth * distance(x, region.min, region.max));
  return size;
}

double WantedSize::without_bores(const Vector3 &x) const
{
  return near(surfaces_, x, refined_ ? std::min(size_, (*refined_)(x)) : size_);
}

double WantedSize::operator()(const Vector3 &x) const
{
  return near(bores_, x, without_bores(x));
}

double excess_of_triangles(const WantedSize &wanted, double unit)
{
  const auto                     points    = points_of_mesh(unit);
  constexpr int                  triangle  = 2; // gmsh's types of elements
  const std::vector<std::size_t> nodes     = nodes_of(triangle, -1);
  double                         requested = 0.;
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 3)
  {
    const Vector3 a = points.at(nodes[i]), b = points.at(nodes[i + 1]), c = points.at(nodes[i + 2]);
    const double  w = wanted((1. / 3.) * (a + b + c));
    requested += 2. / std::sqrt(3.) * norm(cross(b - a, c - a)) / (w * w);
  }
  for (const MeshedEdge &edge : edges_of_mesh(unit))
    requested += 2. * edge.n_sides;
  return double(nodes.size()) / 3. / requested;
}

bool has_size_fields()
{
  const int next = gmsh::model::mesh::field::add("Min"); // takes the first free number; scripts count from 1
  gmsh::model::mesh::field::remove(next);
  return next > 1;
}

ShortEdges grade_from_short_edges(const WantedSize &wanted, const CadModel &model, const MeshOptions &options,
                                  const Selection &selection)
{
  struct Alike
  {
    std::vector<double> curves;
    double              side     = std::numeric_limits<double>::infinity(); ///< the shortest [m]
    int                 n_points = 2;
  };
  std::map<int, Alike> alike; // by the length of their sides, within a factor sqrt(2)
  ShortEdges           edges;
  constexpr double     half = 0.5; // of the wanted size: shorter sides are short
  for (const MeshedEdge &edge : edges_of_mesh(model.unit))
    if (edge.side > 0. && edge.side < half * wanted.without_bores(edge.at))
    {
      Alike &group                 = alike[static_cast<int>(std::floor(2. * std::log2(edge.side)))];
      group.side                   = std::min(group.side, edge.side);
      constexpr int most_per_curve = 200; // points that represent a curve in gmsh's distance field
      group.n_points               = std::clamp(edge.n_sides + 1, group.n_points, most_per_curve);
      group.curves.push_back(edge.tag);
      edges.shortest = edges.n++ > 0 ? std::min(edges.shortest, edge.side) : edge.side;
    }

  if (edges.n == 0)
    return edges;
  std::vector<double> fields = surface_size_fields(model, options, selection);
  for (const auto &[bin, group] : alike)
    fields.push_back(add_field(group.curves, group.n_points, group.side / model.unit, options.size / model.unit));
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0.);
  set_smallest_as_background(fields);
  return edges;
}

} // namespace gestell::fem
