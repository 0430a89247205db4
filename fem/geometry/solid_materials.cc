#include "fem/geometry/solid_materials.h"

#include "fem/values/nearest_name.h"

#include <fnmatch.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace gestell::fem
{

std::vector<std::size_t> solids_of(const std::pair<std::string, Material> &named,
                                   const std::vector<std::string>         &solids)
{
  const auto &[pattern, material] = named;
  std::vector<std::size_t> fitting;
  for (std::size_t solid = 0; solid < solids.size(); ++solid)
    if (fnmatch(pattern.c_str(), solids[solid].c_str(), 0) == 0)
      fitting.push_back(solid);
  if (fitting.empty())
    throw std::invalid_argument((material.place.empty() ? "frame.materials" : material.place) +
                                ": there is no solid \"" + pattern + "\"; " + nearest_names(pattern, solids, "solid") +
                                "; `gestell mesh` lists all solids of a file.");
  return fitting;
}

std::vector<Material> materials_of(const FrameSpecification &specification, const std::vector<std::string> &solids)
{
  std::vector<Material> materials(solids.size(), specification.material);
  for (const auto &named : specification.materials)
    for (const std::size_t solid : solids_of(named, solids))
      materials[solid] = named.second;
  return materials;
}

void check_materials(CadModel &model, const FrameSpecification &specification)
{
  std::vector<std::string> names;
  for (const Solid &solid : model.solids)
    names.push_back(solid.name);
  const std::vector<Material>                     materials = materials_of(specification, names);
  std::map<std::string, std::vector<std::string>> of_file, differ; // solids by text
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const Solid      &solid = model.solids[i];
    const Material   &given = materials[i];
    const std::string own =
        text(solid.density) + " kg/m^3" + (solid.material.empty() ? "" : " (" + solid.material + ")");
    if (given.E == 0.)
      continue; // only the mesh is wanted
    if (given.rho == 0. && solid.density == 0.)
      throw std::invalid_argument((given.place.empty() ? specification.place : given.place) +
                                  ": no density rho is given, and " + specification.cad + " has none for solid \"" +
                                  solid.name + "\"; add one, such as rho = \"7850 kg/m^3\" of steel.");
    constexpr double balsa = 50., osmium = 25000.; // [kg/m^3] outside, the file has another unit
    if (given.rho == 0. && (solid.density < balsa || solid.density > osmium))
      throw std::invalid_argument(specification.place + ": the density of solid \"" + solid.name + "\" is " + own +
                                  " in " + specification.cad +
                                  ", which no solid material has; correct its unit, or add rho to the material.");
    constexpr double rounding = 1e-3; // of a density in a CAD file: three or four digits
    if (given.rho == 0.)
      of_file["the density is " + own + ", from the file"].push_back(solid.name);
    else if (solid.density > 0. && std::abs(given.rho / solid.density - 1.) > rounding)
      differ["the density is " + text(given.rho) + " kg/m^3, but " + own + " in the file"].push_back(solid.name);
  }
  const auto lines = [](const auto &solids_by_text, std::vector<std::string> &result)
  {
    for (const auto &[words, solids] : solids_by_text)
      result.push_back("solid \"" + solids.front() + "\"" +
                       (solids.size() > 1 ? " and " + std::to_string(solids.size() - 1) + " more" : "") + ": " + words);
  };
  lines(of_file, model.statements);
  lines(differ, model.notes);
}

} // namespace gestell::fem
