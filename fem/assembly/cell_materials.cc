#include "fem/assembly/cell_materials.h"

#include "fem/geometry/solid_materials.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

void require_range(const Material &material, bool holds, const char *quantity, double value, const char *needed,
                   const char *remedy)
{
  if (holds)
    return;
  std::ostringstream message;
  message << (material.place.empty() ? "material" : material.place) << ": " << quantity << " = " << value << ", but "
          << needed << " is needed; " << remedy << ".";
  throw std::invalid_argument(message.str());
}

} // namespace

void require_valid(const Material &material)
{
  const auto &[E, nu, rho, place, name] = material;
  require_range(material, std::isfinite(E) && E > 0., "Young's modulus E", E, "E > 0 Pa", "steel has 210 GPa");
  require_range(material, std::isfinite(nu) && nu > -1. && nu < 0.5, "Poisson's ratio nu", nu, "-1 < nu < 0.5",
                "steel has 0.3; these elements lock near the incompressible limit 0.5, use 0.49 at most");
  require_range(material, std::isfinite(rho) && rho > 0., "density rho", rho, "rho > 0 kg/m^3",
                "steel has 7850 kg/m^3");
}

CellMaterials cell_materials(const Mesh &mesh, const FrameSpecification &specification)
{
  CellMaterials result{materials_of(specification, mesh.solids), mesh.cell_solid};
  for (std::size_t solid = 0; solid < result.materials.size(); ++solid)
  {
    Material &material = result.materials[solid];
    if (material.rho == 0. && solid < mesh.densities.size())
      material.rho = mesh.densities[solid];
    require_valid(material);
  }
  return result;
}

} // namespace gestell::fem
