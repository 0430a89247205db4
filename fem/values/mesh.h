#pragma once

#include "fem/values/cell_shape.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

using Point3 = std::array<double, 3>; ///< [m]

/// Faces of cells that move with cells whose nodes are others.
struct MeshTie
{
  std::vector<std::array<int, 4>> faces;  ///< corners in order around it; the last of a triangle is -1
  std::vector<int>                cells;  ///< that lead, of which some are at each face
  std::array<std::string, 2>      solids; ///< names: of the faces, of the cells
};

/// Mesh of a frame with tetrahedra, hexahedra and prisms, numbered in this order; SI.  Edges are straight except those
/// in `middles`.  Faces are ordered so that their normal points outwards.
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
  std::vector<std::string> solids;     ///< names, from the CAD file if it has them
  std::vector<double>      densities;  ///< of the solids in a STEP file [kg/m^3], 0 for none

  /// For meshes of tetrahedra: middles of curved edges, by the points at their ends, the smaller first.
  std::map<std::array<int, 2>, Point3> middles;

  std::vector<MeshTie> ties; ///< cells that lead belong to no face of a later tie

  bool takes_one_size = false; ///< swept, or made by a script: a size field does not refine it

  std::vector<std::string> notes;      ///< warnings about geometry and mesh
  std::vector<std::string> statements; ///< checks that passed

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
