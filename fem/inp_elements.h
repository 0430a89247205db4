#pragma once

#include <string>
#include <vector>

namespace gestell::fem
{

/// What an element of a name is made into.
struct InpElementKind
{
  enum class Use
  {
    solid,
    surface, ///< names a surface
    line     ///< left out
  };
  std::string      begin; ///< of the name of the type
  int              n_nodes;
  Use              use;
  int              gmsh_type;
  std::vector<int> order; ///< of the nodes that are taken
};

/// The kinds that are read.  Prisms and pyramids are among them, so that a mesh that holds some is refused with their
/// number.
const std::vector<InpElementKind> &inp_element_kinds();

/// Corners of the faces S1, S2, ... of a cell, as its nodes stand in the file; none of prisms and pyramids.
const std::vector<std::vector<int>> &faces_of_inp_element(int gmsh_type);

} // namespace gestell::fem
