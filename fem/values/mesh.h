#pragma once

#include "fem/values/cell_shape.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

using Point3 = std::array<double, 3>; ///< [m]

/// Mesh of a frame in tetrahedra, hexahedra and prisms, which are counted in this order; SI.  Edges are straight but
/// for those with a middle.  Faces are ordered so that their normal points outwards.
struct Mesh
{
  std::vector<Point3>             points;
  std::vector<std::array<int, 4>> cells;      ///< tetrahedra, positively oriented
  std::vector<std::array<int, 8>> hexahedra;  ///< corners in the order of gmsh
  std::vector<std::array<int, 6>> prisms;     ///< corners in the order of gmsh
  std::vector<int>                cell_solid; ///< index of the solid a cell belongs to
  std::vector<std::array<int, 3>> skin;       ///< every outer triangle
  std::vector<std::array<int, 4>>
                           skin_quads; ///< outer quadrilaterals; i = abcd has the triangles 2 i = abc, 2 i + 1 = acd
  std::vector<std::string> solids;     ///< names, as in the CAD file where it has them

  /// Of a mesh of tetrahedra alone: middles of edges that are curved, by the points at their ends, the smaller first.
  std::map<std::array<int, 2>, Point3> middles;

  bool takes_one_size = false; ///< swept, or made by a script: no field of sizes refines it

  std::vector<std::string> notes;      ///< what a user should look at in the geometry and the mesh
  std::vector<std::string> statements; ///< what is as it should be

  /// Named surfaces: triangles of the skin, as indices into `skin`.
  std::map<std::string, std::vector<int>> surfaces;

  int  n_cells() const { return static_cast<int>(cells.size() + hexahedra.size() + prisms.size()); }
  bool only_tetrahedra() const { return hexahedra.empty() && prisms.empty(); }

  CellKind kind(int cell) const
  {
    const std::size_t i = static_cast<std::size_t>(cell);
    return i < cells.size()                      ? CellKind::tetrahedron
           : i < cells.size() + hexahedra.size() ? CellKind::hexahedron
                                                 : CellKind::prism;
  }
  const int *corners(int cell) const
  {
    const std::size_t i = static_cast<std::size_t>(cell), j = i - cells.size();
    return i < cells.size()       ? cells[i].data()
           : j < hexahedra.size() ? hexahedra[j].data()
                                  : prisms[j - hexahedra.size()].data();
  }
  /// Whether a triangle of the skin is half of a quadrilateral.
  bool is_half(std::size_t triangle) const { return triangle < 2 * skin_quads.size(); }
};

} // namespace gestell::fem
