#pragma once

#include <gmsh.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// The elements of one type in an entity of gmsh.
struct GmshElements
{
  int                      n_nodes, n_corners; ///< of an element, corners first
  std::vector<double>      local;              ///< [dim n_nodes] positions in the reference element
  std::vector<std::size_t> nodes;              ///< tags, element after element

  std::size_t count() const { return nodes.size() / static_cast<std::size_t>(n_nodes); }
};

/// Elements of an entity, type by type.
inline std::vector<GmshElements> elements_of(int dim, int tag)
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dim, tag);
  std::vector<GmshElements> result(types.size());
  for (std::size_t i = 0; i < types.size(); ++i)
  {
    std::string name;
    int         d, order;
    gmsh::model::mesh::getElementProperties(types[i], name, d, order, result[i].n_nodes, result[i].local,
                                            result[i].n_corners);
    result[i].nodes = std::move(nodes[i]);
  }
  return result;
}

} // namespace gestell::fem
