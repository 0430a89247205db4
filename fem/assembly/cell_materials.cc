#include "fem/assembly/cell_materials.h"

#include "fem/assembly/elasticity.h"
#include "fem/geometry/solid_materials.h"

namespace gestell::fem
{

CellMaterials cell_materials(const Mesh &mesh, const FrameSpecification &specification)
{
  require_valid(specification.material);
  CellMaterials result{{mesh.solids.size(), specification.material}, mesh.cell_solid};
  for (const auto &named : specification.materials)
  {
    require_valid(named.second);
    for (const std::size_t solid : solids_of(named, mesh.solids))
      result.materials[solid] = named.second;
  }
  return result;
}

} // namespace gestell::fem
