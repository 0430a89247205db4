#pragma once

#include "fem/values/mesh.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace gestell::fem
{

struct Grid;

/// Faces that move with cells whose nodes are others, see MeshTie.
struct QuadraticTie
{
  std::vector<std::array<int, 6>> triangles; ///< as in QuadraticMesh::skin
  std::vector<std::array<int, 9>> quads;     ///< as in QuadraticMesh::skin_quads
  std::vector<int>                cells;     ///< hexahedra that lead
  std::array<std::string, 2>      solids;    ///< names: of the faces, of the cells
};

/**
 * Nodes of quadratic cells (10 of a tetrahedron, 27 of a hexahedron, 18 of a prism): corners of a mesh, middles of its
 * edges, curved or straight, of its quadrilateral faces and of hexahedra.
 *
 * Displacement d of node i is number 3 i + d of the nodal vector u [3 n_nodes], as a DoFHandler of deal.II numbers it
 * with an FESystem of three such elements.  Within a cell the nodes are in the order of deal.II's elements.
 */
struct QuadraticMesh
{
  std::vector<Point3>              points;    ///< [m]
  std::vector<std::array<int, 10>> cells;     ///< tetrahedra, into points; cells are counted as in Mesh
  std::vector<std::array<int, 27>> hexahedra; ///< FE_Q(2)
  std::vector<std::array<int, 18>> prisms;    ///< FE_WedgeP(2)
  std::vector<char>                curved;    ///< of each tetrahedron whether one of its edges is; empty if none is
  std::vector<std::array<int, 6>>  skin; ///< corners a b c, then the middles of ab, bc, ca; same order as Mesh::skin
  std::vector<std::array<int, 9>>  skin_quads; ///< FE_Q(2) of two dimensions; same order as Mesh::skin_quads
  std::vector<QuadraticTie>        ties;
  std::vector<int>                 node_of; ///< node at point i of the mesh, or -1 if no cell uses it
  std::shared_ptr<const Grid>      grid;    ///< the cells as deal.II's Triangulation

  int  n_nodes() const { return static_cast<int>(points.size()); }
  int  n_cells() const { return static_cast<int>(cells.size() + hexahedra.size() + prisms.size()); }
  bool is_curved(int cell) const { return !curved.empty() && curved[cell] != 0; }

  CellKind kind(int cell) const
  {
    const std::size_t i = static_cast<std::size_t>(cell);
    return i < cells.size()                      ? CellKind::tetrahedron
           : i < cells.size() + hexahedra.size() ? CellKind::hexahedron
                                                 : CellKind::prism;
  }
  int n_nodes_of(int cell) const
  {
    const CellKind of = kind(cell);
    return of == CellKind::tetrahedron ? 10 : of == CellKind::hexahedron ? 27 : 18;
  }
  const int *nodes(int cell) const
  {
    const std::size_t i = static_cast<std::size_t>(cell), j = i - cells.size();
    return i < cells.size()       ? cells[i].data()
           : j < hexahedra.size() ? hexahedra[j].data()
                                  : prisms[j - hexahedra.size()].data();
  }
};

/// Nodes of a cell as columns [3 x n_nodes].
inline Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 27> positions(const QuadraticMesh &mesh, int cell)
{
  const int                                          n     = mesh.n_nodes_of(cell);
  const int                                         *nodes = mesh.nodes(cell);
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 27> X(3, n);
  for (int a = 0; a < n; ++a)
    X.col(a) = Eigen::Map<const Eigen::Vector3d>(mesh.points[nodes[a]].data());
  return X;
}

/**
 * The nodes as deal.II's DoFHandler numbers them on the cells of a mesh: FE_SimplexP(2), FE_Q(2) or FE_WedgeP(2). Nodes
 * of several kinds are numbered cell by cell.
 *
 * @throws std::invalid_argument for a mesh without cells, a cell without volume or inverted at a corner, or an outer
 * face that is not a face of a cell.
 */
QuadraticMesh quadratic_mesh(const Mesh &mesh);

} // namespace gestell::fem
