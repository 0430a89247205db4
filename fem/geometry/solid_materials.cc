#include "fem/geometry/solid_materials.h"

#include "fem/values/nearest_name.h"

#include <fnmatch.h>

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

} // namespace gestell::fem
