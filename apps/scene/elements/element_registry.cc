#include "apps/scene/elements/element_registry.h"

#include "apps/scene/read/read_switches.h"

namespace gestell::apps
{

void read_spring_damper(const SceneTable &, const Names &, Scene &);
void read_point_mass(const SceneTable &, const Names &, Scene &);
void read_connecting_rod(const SceneTable &, const Names &, Scene &);
void read_blanking_force(const SceneTable &, const Names &, Scene &);
void read_cutting_force(const SceneTable &, const Names &, Scene &);
void read_asynchronous_motor(const SceneTable &, const Names &, Scene &);
void read_clearance(const SceneTable &, const Names &, Scene &);
void read_contact_point(const SceneTable &, const Names &, Scene &);
void read_guide_with_play(const SceneTable &, const Names &, Scene &);
void read_journal_bearing(const SceneTable &, const Names &, Scene &);
void read_stop(const SceneTable &, const Names &, Scene &);
void read_friction(const SceneTable &, const Names &, Scene &);
void read_dry_friction(const SceneTable &, const Names &, Scene &);
void read_cubic_spring(const SceneTable &, const Names &, Scene &);
void read_force(const SceneTable &, const Names &, Scene &);
void read_table_force(const SceneTable &, const Names &, Scene &);
void read_wheel(const SceneTable &, const Names &, Scene &);
void read_formula_force(const SceneTable &, const Names &, Scene &);
void read_force_profile(const SceneTable &, const Names &, Scene &);
void read_speed_drive(const SceneTable &, const Names &, Scene &);
void read_dynamic_motor(const SceneTable &, const Names &, Scene &);
void read_hydraulic_cylinder(const SceneTable &, const Names &, Scene &);
void read_brake(const SceneTable &, const Names &, Scene &);
void read_clutch(const SceneTable &, const Names &, Scene &);
void read_rope(const SceneTable &, const Names &, Scene &);
void read_lugre_friction(const SceneTable &, const Names &, Scene &);
void read_gas_force(const SceneTable &, const Names &, Scene &);
void read_drawing_force(const SceneTable &, const Names &, Scene &);

const std::vector<ElementType> &element_types()
{
  static const std::vector<ElementType> types = {
      {"spring-damper", read_spring_damper},
      {"point mass", read_point_mass},
      {"connecting rod", read_connecting_rod},
      {"blanking force", read_blanking_force},
      {"cutting force", read_cutting_force},
      {"asynchronous motor", read_asynchronous_motor},
      {"clearance", read_clearance},
      {"stop", read_stop},
      {"journal bearing", read_journal_bearing},
      {"contact", read_contact_point},
      {"guide with play", read_guide_with_play},
      {"friction", read_friction},
      {"dry friction", read_dry_friction},
      {"cubic spring", read_cubic_spring},
      {"force", read_force},
      {"table force", read_table_force},
      {"wheel", read_wheel},
      {"formula force", read_formula_force},
      {"force profile", read_force_profile},
      {"speed drive", read_speed_drive},
      {"dynamic motor", read_dynamic_motor},
      {"hydraulic cylinder", read_hydraulic_cylinder},
      {"brake", read_brake},
      {"clutch", read_clutch},
      {"rope", read_rope},
      {"lugre friction", read_lugre_friction},
      {"gas force", read_gas_force},
      {"drawing force", read_drawing_force},
  };
  return types;
}

void read_elements(const SceneTable &table, const Names &names, Scene &scene)
{
  std::vector<std::string> types;
  for (const auto &type : element_types())
    types.push_back(type.name);
  for (const auto &element : table.tables("element"))
  {
    check_thing_name(element);
    if (names.find_body(element.name()))
      throw element.error("a body has the name '" + element.name() + "' too; signals could not tell them apart");
    scene.element_places[element.name()] = element.place();
    const std::string type               = element.choice("type", types, "");
    for (const auto &known : element_types())
      if (known.name == type)
        known.read(element, names, scene);
    if (element.choice("initially", {"on", "off"}, "on") == "off")
      begin_off(element, scene);
  }
}

} // namespace gestell::apps
