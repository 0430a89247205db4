#include "fem/cell_materials.h"

#include "fem/elasticity.h"
#include "fem/nearest_name.h"

#include <fnmatch.h>

#include <stdexcept>

namespace gestell::fem
{

CellMaterials cell_materials(const Mesh &mesh, const FrameSpecification &specification)
{
  require_valid(specification.material);
  CellMaterials result{{mesh.solids.size(), specification.material}, mesh.cell_solid};
  for (const auto &[pattern, material] : specification.materials)
  {
    require_valid(material);
    bool fits = false;
    for (std::size_t solid = 0; solid < mesh.solids.size(); ++solid)
      if (fnmatch(pattern.c_str(), mesh.solids[solid].c_str(), 0) == 0)
      {
        result.materials[solid] = material;
        fits                    = true;
      }
    if (!fits)
      throw std::invalid_argument(
          (material.place.empty() ? "frame.materials" : material.place) + ": no solid is called \"" + pattern + "\"; " +
          nearest_names(pattern, mesh.solids, "solid") + "; `gestell mesh` lists all solids of a file.");
  }
  return result;
}

} // namespace gestell::fem
