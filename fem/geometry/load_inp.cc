#include "fem/geometry/load_inp.h"

#include "fem/geometry/inp/inp_file.h"

#include <gmsh.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

namespace
{

/// gmsh's types of the same cells without and with middle nodes, and the nodes of the second.
struct Degrees
{
  int         linear, quadratic;
  std::size_t n_corners, n_nodes;
};
constexpr Degrees both[] = {{4, 11, 4, 10}, {5, 17, 8, 20}, {6, 18, 6, 15}};

/// gmsh finds but one of both degrees of a kind of cells in a volume: there the corners of the quadratic ones are
/// taken.
void make_degrees_equal(InpMesh &mesh)
{
  std::set<std::pair<std::string, int>> there;
  for (const auto &elements : mesh.elements)
    there.emplace(elements.solid, elements.gmsh_type);
  for (auto &elements : mesh.elements)
    for (const auto &[linear, quadratic, n_corners, n_nodes] : both)
    {
      if (elements.gmsh_type != quadratic || there.count({elements.solid, linear}) == 0)
        continue;
      elements.gmsh_type = linear;
      std::vector<std::size_t> corners;
      for (std::size_t i = 0; i < elements.nodes.size(); i += n_nodes)
        corners.insert(corners.end(), &elements.nodes[i], &elements.nodes[i] + n_corners);
      elements.nodes = std::move(corners);
      mesh.notes.push_back("the solid \"" + elements.solid +
                           "\" has cells with and without middle nodes: all are taken with straight edges");
      break;
    }
}

} // namespace

MeshGroups load_inp(CadModel &model, const CadSource &source)
{
  InpMesh mesh = read_inp(source);
  make_degrees_equal(mesh);
  model.notes = mesh.notes;
  if (mesh.elements.empty())
    return {};
  std::map<std::string, int> volume;
  for (const auto &elements : mesh.elements)
  {
    const auto [entry, is_new] = volume.try_emplace(elements.solid, static_cast<int>(volume.size()) + 1);
    if (!is_new)
      continue;
    gmsh::model::addDiscreteEntity(3, entry->second);
    gmsh::model::setEntityName(3, entry->second, elements.solid);
    if (entry->second == 1)
      gmsh::model::mesh::addNodes(3, 1, mesh.numbers, mesh.coordinates);
  }
  for (const auto &elements : mesh.elements)
    gmsh::model::mesh::addElementsByType(volume.at(elements.solid), elements.gmsh_type, elements.numbers,
                                         elements.nodes);
  return {mesh.node_sets, mesh.faces};
}

} // namespace gestell::fem
