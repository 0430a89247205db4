#include "coupling/frame/mesh_convergence.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

bool has(const MeshLevel &level, const std::string &name)
{
  return std::find(level.names.begin(), level.names.end(), name) != level.names.end();
}

/// The quantities of these names, in their order.
void reorder(MeshLevel &level, const std::vector<std::string> &names)
{
  std::vector<double> values, estimates;
  for (const std::string &name : names)
  {
    const auto at = std::find(level.names.begin(), level.names.end(), name) - level.names.begin();
    values.push_back(level.values[at]);
    estimates.push_back(level.estimates[at]);
  }
  level.names     = names;
  level.values    = std::move(values);
  level.estimates = std::move(estimates);
}

} // namespace

std::vector<std::string> keep_common(std::vector<MeshLevel> &levels)
{
  std::vector<std::string> common, left_out;
  for (const MeshLevel &level : levels)
    for (const std::string &name : level.names)
    {
      const bool in_all = std::all_of(levels.begin(), levels.end(), [&](const MeshLevel &l) { return has(l, name); });
      auto      &to     = in_all ? common : left_out;
      if (std::find(to.begin(), to.end(), name) == to.end())
        to.push_back(name);
    }
  for (MeshLevel &level : levels)
    reorder(level, common);
  return left_out;
}

} // namespace gestell::coupling
