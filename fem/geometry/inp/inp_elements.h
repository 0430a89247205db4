#pragma once

#include <array>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Target type of an Abaqus or CalculiX element.
struct InpElementKind
{
  enum class Use
  {
    solid,
    surface, ///< names a surface
    line     ///< ignored
  };
  std::string      begin; ///< start of the name of the type
  int              n_nodes;
  Use              use;
  int              gmsh_type;
  std::vector<int> order; ///< of the nodes used
};

/// The kind of elements of a type in capitals, including variants (C3D10M, C3D8R, ...); null if they are not supported.
/// Pyramids are recognised, so that a mesh with pyramids is rejected with their number.
const InpElementKind *inp_element_kind(const std::string &type);

/// Corners of the faces S1, S2, ... of a cell, in the order of its nodes in the file; none for pyramids.
const std::vector<std::vector<int>> &inp_faces(int gmsh_type);

/// Edges of a cell of quadratic tetrahedra, hexahedra or prisms, by its corners, in the order of their middle nodes in
/// the file; none of others.
const std::vector<std::array<int, 2>> &inp_edges(int gmsh_type);

} // namespace gestell::fem
