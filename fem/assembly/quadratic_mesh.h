#pragma once

#include "fem/values/mesh.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * Nodes of quadratic cells: the corners of a mesh and the middles of its edges, curved or straight; of hexahedra those
 * of faces and cells as well.
 *
 * Displacement d of node i is number 3 i + d of the nodal vector u [3 n_nodes].  Within a cell or triangle the nodes
 * stand in the order of the reference elements: corners first, then edges.
 */
struct QuadraticMesh
{
  std::vector<Point3>              points;    ///< [m]
  std::vector<std::array<int, 10>> cells;     ///< into points; same order as Mesh::cells
  std::vector<char>                curved;    ///< of each tetrahedron whether one of its edges is; empty if none is
  std::vector<std::array<int, 27>> hexahedra; ///< in place of tetrahedra, in the order of hexahedron::corners
  std::vector<std::array<int, 6>>  skin; ///< corners a b c, then the middles of ab, bc, ca; same order as Mesh::skin
  std::vector<std::array<int, 9>>  skin_quads; ///< of hexahedra, node i + 3 j; same order as Mesh::skin_quads
  std::vector<int>                 node_of;    ///< node at point i of the mesh, or -1 where no cell uses it

  int        n_nodes() const { return static_cast<int>(points.size()); }
  int        n_cells() const { return static_cast<int>(cells.size() + hexahedra.size()); }
  int        nodes_per_cell() const { return hexahedra.empty() ? 10 : 27; }
  bool       is_curved(int cell) const { return !curved.empty() && curved[cell] != 0; }
  const int *nodes(int cell) const { return hexahedra.empty() ? cells[cell].data() : hexahedra[cell].data(); }
};

/**
 * Numbers the nodes of tetrahedra by a DoFHandler of deal.II with FE_SimplexP<3>(2); see number_nodes() for both kinds.
 *
 * @throws std::invalid_argument for a mesh without cells, a cell without volume or a skin triangle that is no face.
 */
QuadraticMesh quadratic_mesh(const Mesh &mesh);

} // namespace gestell::fem
