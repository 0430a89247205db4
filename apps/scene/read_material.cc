#include "apps/scene/read_material.h"

#include <map>

namespace gestell::apps
{
namespace
{

fem::Material material_from(const SceneTable &table)
{
  fem::Material material;
  material.E     = table.positive("E", kind::pressure);
  material.nu    = table.number("nu", kind::number);
  material.rho   = table.positive("rho", kind::density);
  material.place = table.place();
  if (material.nu <= -1. || material.nu >= 0.5)
    throw table.error("nu", "Poisson's ratio must lie above -1 and below 0.5; steel has 0.3");
  return material;
}

} // namespace

fem::Material read_material(const SceneTable &table, const SceneTable &scene)
{
  // Handbook values at room temperature; own materials may redefine them.
  std::map<std::string, fem::Material> known = {{"steel", {210e9, 0.3, 7850., ""}},
                                                {"cast iron", {110e9, 0.26, 7200., ""}},
                                                {"aluminium", {70e9, 0.33, 2700., ""}}};
  for (const auto &own : scene.tables("material"))
    known[own.name()] = material_from(own);
  if (table.is_table("material"))
    return material_from(table.table("material"));
  std::vector<std::string> names;
  for (const auto &entry : known)
    names.push_back(entry.first);
  fem::Material material = known.at(table.choice("material", names, "steel"));
  material.place         = table.place("material");
  return material;
}

} // namespace gestell::apps
