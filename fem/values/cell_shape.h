#pragma once

#include <array>
#include <vector>

namespace gestell::fem
{

enum class CellKind
{
  tetrahedron,
  hexahedron,
  prism
};

/// Corners, edges and faces of a kind of cells; corners in the order of gmsh.
struct CellShape
{
  int                             n_corners;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>>   faces;  ///< counterclockwise as seen from outside
  std::vector<std::array<int, 3>> triads; ///< for each corner the ends of its edges, right-handed
  std::vector<std::array<int, 4>> pieces; ///< positively oriented tetrahedra that form the cell
};

const CellShape &cell_shape(CellKind kind);

} // namespace gestell::fem
