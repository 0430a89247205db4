#include "fem/mesh/cell_kinds.h"

#include "fem/mesh/gmsh_elements.h"

#include <map>
#include <stdexcept>
#include <vector>

namespace gestell::fem
{

namespace
{

/// By the number of corners, which tells the kinds of cells apart.
std::map<int, std::size_t> count_by_corners(const CadModel &model)
{
  std::map<int, std::size_t> count;
  for (const Solid &solid : model.solids)
    for (const GmshElements &elements : elements_of(3, solid.tag))
      count[elements.n_corners] += elements.count();
  return count;
}

constexpr int tetrahedron = 4, pyramid = 5, prism = 6, hexahedron = 8; // corners

std::string in_words(const std::map<int, std::size_t> &count)
{
  static const std::map<int, std::string> names = {
      {tetrahedron, "tetrahedra"}, {hexahedron, "hexahedra"}, {prism, "prisms (wedges)"}, {pyramid, "pyramids"}};
  std::string words;
  std::size_t left = count.size();
  for (const auto &[n_corners, n] : count)
  {
    const auto name = names.find(n_corners);
    words += (words.empty() ? ""
              : left == 1   ? " and "
                            : ", ") +
             std::to_string(n) + " " +
             (name == names.end() ? "cells of " + std::to_string(n_corners) + " corners" : name->second);
    --left;
  }
  return words;
}

} // namespace

CellKind kind_of_cells(const CadModel &model, const std::string &head)
{
  const auto count = count_by_corners(model);
  if (count.empty() || (count.size() == 1 && count.begin()->first == tetrahedron))
    return CellKind::tetrahedra;
  if (count.size() == 1 && count.begin()->first == hexahedron)
    return CellKind::hexahedra;
  throw std::invalid_argument(
      head + " holds " + in_words(count) +
      ", but a mesh must be of tetrahedra throughout or of hexahedra throughout. Mesh it with tetrahedra alone (gmsh: "
      "without Recombine; Abaqus: C3D10), or with hexahedra alone (gmsh: every volume transfinite, or extruded in "
      "Layers from quadrilaterals, with Recombine; Abaqus: C3D8 or C3D20).");
}

} // namespace gestell::fem
