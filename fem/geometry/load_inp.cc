#include "fem/geometry/load_inp.h"

#include "fem/geometry/inp_file.h"

#include <gmsh.h>

#include <map>
#include <string>

namespace gestell::fem
{

MeshGroups load_inp(CadModel &model, const CadSource &source)
{
  const InpMesh mesh = read_inp(source);
  model.notes        = mesh.notes;
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
