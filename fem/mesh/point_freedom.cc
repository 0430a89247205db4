#include "fem/mesh/point_freedom.h"

#include "fem/values/vector3.h"

#include <gmsh.h>

#include <cmath>
#include <unordered_map>

namespace gestell::fem
{

namespace
{

/// Two unit vectors that span the plane with the unit normal n.
Freedom within_plane(const Vector3 &n)
{
  const Vector3 aside = std::abs(n[0]) < 0.6 ? Vector3{1., 0., 0.} : Vector3{0., 1., 0.};
  const Vector3 u     = unit(cross(n, aside));
  return {u, cross(n, u)};
}

Freedom along_curve(int tag)
{
  std::string type;
  gmsh::model::getType(1, tag, type);
  if (type != "Line")
    return {};
  std::vector<double> low, high, d;
  gmsh::model::getParametrizationBounds(1, tag, low, high);
  gmsh::model::getDerivative(1, tag, low, d);
  const Vector3 tangent{d[0], d[1], d[2]};
  return norm(tangent) > 0. ? Freedom{unit(tangent)} : Freedom{};
}

class Freedoms
{
public:
  /// Gives this freedom to all points inside the entity (not those on its boundary).
  void set(int dim, int tag, const Freedom &freedom)
  {
    std::vector<std::size_t> nodes;
    std::vector<double>      coordinates, parameters;
    gmsh::model::mesh::getNodes(nodes, coordinates, parameters, dim, tag, false, false);
    for (const std::size_t node : nodes)
      freedom_[node] = freedom;
  }

  std::vector<Freedom> of(const std::vector<std::size_t> &nodes) const
  {
    std::vector<Freedom> list;
    for (const std::size_t node : nodes)
    {
      const auto entry = freedom_.find(node);
      list.push_back(entry == freedom_.end() ? Freedom{} : entry->second);
    }
    return list;
  }

private:
  std::unordered_map<std::size_t, Freedom> freedom_;
};

} // namespace

std::vector<Freedom> point_freedom(const CadModel &model, const std::vector<std::size_t> &node)
{
  Freedoms freedoms;
  for (const Solid &solid : model.solids)
    freedoms.set(3, solid.tag, {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}});
  for (const Face &face : model.faces)
    if (face.kind == FaceKind::plane)
      freedoms.set(2, face.tag, within_plane(face.direction));

  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto &[dim, tag] : curves)
    freedoms.set(1, tag, along_curve(tag));
  return freedoms.of(node);
}

} // namespace gestell::fem
