#include "fem/mesh/cell_kinds.h"

#include "fem/mesh/gmsh_elements.h"

#include <map>
#include <stdexcept>

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

bool only_tetrahedra(const CadModel &model, const std::string &head)
{
  const auto count = count_by_corners(model);
  const auto holds = [&](int corners) { return count.count(corners) > 0; };
  bool       known = true;
  for (const auto &[corners, n] : count)
    known = known && (corners == tetrahedron || corners == prism || corners == hexahedron);
  if (known && (!holds(tetrahedron) || !holds(hexahedron) || holds(prism)))
    return !holds(prism) && !holds(hexahedron);
  throw std::invalid_argument(
      head + " holds " + in_words(count) +
      ", but a mesh must be of tetrahedra, of hexahedra or of prisms, or of prisms with others: no quadratic pyramid "
      "stands between tetrahedra and hexahedra. Mesh it with tetrahedra alone (gmsh: without Recombine; Abaqus: "
      "C3D10), "
      "or extruded in Layers: hexahedra from quadrilaterals, prisms from triangles, with Recombine (Abaqus: C3D20, "
      "C3D15).");
}

} // namespace gestell::fem
