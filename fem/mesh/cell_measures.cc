#include "fem/mesh/cell_measures.h"

#include "fem/mesh/mesh_quality.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::fem
{

namespace
{

/// Edges (the last two corners -1) and quadrilaterals of a cell by their corners, sorted.
template <typename Visit>
void for_each_inner_node(const Mesh &mesh, int cell, const Visit &visit)
{
  const CellShape &shape   = cell_shape(mesh.kind(cell));
  const int       *corners = mesh.corners(cell);
  for (const auto &[a, b] : shape.edges)
    visit(std::array<int, 4>{-1, -1, std::min(corners[a], corners[b]), std::max(corners[a], corners[b])});
  for (const auto &face : shape.faces)
    if (face.size() == 4)
    {
      std::array<int, 4> key{corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]};
      std::sort(key.begin(), key.end());
      visit(key);
    }
}

} // namespace

int number_of_nodes(const Mesh &mesh)
{
  std::vector<std::array<int, 4>> keys;
  keys.reserve(8 * static_cast<std::size_t>(mesh.n_cells()));
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for_each_inner_node(mesh, cell, [&](const std::array<int, 4> &key) { keys.push_back(key); });
  std::sort(keys.begin(), keys.end());
  return static_cast<int>(std::unique(keys.begin(), keys.end()) - keys.begin()) +
         static_cast<int>(mesh.points.size() + mesh.hexahedra.size());
}

double corner_quality(const Mesh &mesh, int cell)
{
  const CellShape &shape   = cell_shape(mesh.kind(cell));
  const int       *corners = mesh.corners(cell);
  double           worst   = std::numeric_limits<double>::infinity();
  for (int c = 0; c < shape.n_corners; ++c)
  {
    const auto   edge   = [&](int k) { return mesh.points[corners[shape.triads[c][k]]] - mesh.points[corners[c]]; };
    const double length = norm(edge(0)) * norm(edge(1)) * norm(edge(2));
    if (!(length > 0.)) // corners upon each other
      return 0.;
    worst = std::min(worst, dot(edge(0), cross(edge(1), edge(2))) / length);
  }
  return worst;
}

double cell_quality(const Mesh &mesh, int cell)
{
  switch (mesh.kind(cell))
  {
  case CellKind::tetrahedron:
    return quality(mesh, mesh.cells[cell]);
  case CellKind::prism:
    return corner_quality(mesh, cell) / std::sqrt(0.75);
  default:
    return corner_quality(mesh, cell);
  }
}

std::vector<std::array<int, 4>> tetrahedra_of(const Mesh &mesh)
{
  std::vector<std::array<int, 4>> result = mesh.cells;
  for (int cell = static_cast<int>(mesh.cells.size()); cell < mesh.n_cells(); ++cell)
    for (const auto &[a, b, c, d] : cell_shape(mesh.kind(cell)).pieces)
    {
      const int *corners = mesh.corners(cell);
      result.push_back({corners[a], corners[b], corners[c], corners[d]});
    }
  return result;
}

} // namespace gestell::fem
