#include "fem/geometry/inp/inp_elements.h"

#include <cctype>

namespace gestell::fem
{

namespace
{

const std::vector<InpElementKind> &kinds()
{
  using Use                                    = InpElementKind::Use;
  static const std::vector<InpElementKind> all = {
      {"C3D10", 10, Use::solid, 11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}}, // gmsh swaps the last two edges
      {"C3D20", 20, Use::solid, 17, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14}},
      {"C3D15", 15, Use::solid, 18, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10}},
      {"C3D4", 4, Use::solid, 4, {0, 1, 2, 3}},
      {"C3D5", 5, Use::solid, 7, {0, 1, 2, 3, 4}},
      {"C3D6", 6, Use::solid, 6, {0, 1, 2, 3, 4, 5}},
      {"C3D8", 8, Use::solid, 5, {0, 1, 2, 3, 4, 5, 6, 7}},
      {"CPS3", 3, Use::surface, 0, {0, 1, 2}},
      {"CPE3", 3, Use::surface, 0, {0, 1, 2}},
      {"S3", 3, Use::surface, 0, {0, 1, 2}},
      {"CPS6", 6, Use::surface, 0, {0, 1, 2}},
      {"CPE6", 6, Use::surface, 0, {0, 1, 2}},
      {"S6", 6, Use::surface, 0, {0, 1, 2}},
      {"STRI65", 6, Use::surface, 0, {0, 1, 2}},
      {"CPS4", 4, Use::surface, 0, {0, 1, 2, 3}},
      {"CPE4", 4, Use::surface, 0, {0, 1, 2, 3}},
      {"S4", 4, Use::surface, 0, {0, 1, 2, 3}},
      {"CPS8", 8, Use::surface, 0, {0, 1, 2, 3}},
      {"CPE8", 8, Use::surface, 0, {0, 1, 2, 3}},
      {"S8", 8, Use::surface, 0, {0, 1, 2, 3}},
      {"T3D2", 2, Use::line, 0, {}},
      {"T3D3", 3, Use::line, 0, {}},
  };
  return all;
}

} // namespace

const InpElementKind *inp_element_kind(const std::string &type)
{
  for (const InpElementKind &kind : kinds())
    if (type.compare(0, kind.begin.size(), kind.begin) == 0 &&
        (type.size() == kind.begin.size() || !std::isdigit(static_cast<unsigned char>(type[kind.begin.size()]))))
      return &kind;
  return nullptr;
}

const std::vector<std::vector<int>> &inp_faces(int gmsh_type)
{
  static const std::vector<std::vector<int>> tetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  static const std::vector<std::vector<int>> hexahedron  = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                                            {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  static const std::vector<std::vector<int>> prism = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<std::vector<int>> none;
  return gmsh_type == 5 || gmsh_type == 17   ? hexahedron
         : gmsh_type == 4 || gmsh_type == 11 ? tetrahedron
         : gmsh_type == 6 || gmsh_type == 18 ? prism
                                             : none;
}

const std::vector<std::array<int, 2>> &inp_edges(int gmsh_type)
{
  static const std::vector<std::array<int, 2>> tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  static const std::vector<std::array<int, 2>> hexahedron  = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  static const std::vector<std::array<int, 2>> prism       = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                              {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  static const std::vector<std::array<int, 2>> none;
  return gmsh_type == 11 ? tetrahedron : gmsh_type == 17 ? hexahedron : gmsh_type == 18 ? prism : none;
}

} // namespace gestell::fem
