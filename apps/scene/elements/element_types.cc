#include "apps/scene/elements/element_types.h"

#include "apps/scene/file/typed_table.h"
#include "apps/scene/read/read_switches.h"

namespace gestell::apps
{

using TypeOfElement = ElementType();

TypeOfElement spring_damper_type, point_mass_type, connecting_rod_type, blanking_force_type, cutting_force_type,
    asynchronous_motor_type, clearance_type, stop_type, journal_bearing_type, contact_type, guide_with_play_type,
    friction_type, dry_friction_type, cubic_spring_type, force_type, table_force_type, wheel_type, formula_force_type,
    force_profile_type, speed_drive_type, dynamic_motor_type, hydraulic_cylinder_type, brake_type, clutch_type,
    rope_type, lugre_friction_type, gas_force_type, drawing_force_type, belt_type, chain_type, gear_pair_type,
    rolling_bearing_type;

const std::vector<ElementType> &element_types()
{
  static const auto types = made<ElementType>(
      spring_damper_type, point_mass_type, connecting_rod_type, blanking_force_type, cutting_force_type,
      asynchronous_motor_type, clearance_type, stop_type, journal_bearing_type, contact_type, guide_with_play_type,
      friction_type, dry_friction_type, cubic_spring_type, force_type, table_force_type, wheel_type, formula_force_type,
      force_profile_type, speed_drive_type, dynamic_motor_type, hydraulic_cylinder_type, brake_type, clutch_type,
      rope_type, lugre_friction_type, gas_force_type, drawing_force_type, belt_type, chain_type, gear_pair_type,
      rolling_bearing_type);
  return types;
}

std::vector<Key> common_element_keys()
{
  return {key::choice("type", names_of(element_types()), false, "type of the element"),
          key::choice("initially", {"on", "off"}, true, "initial state; a switch can change it")};
}

void read_elements(const SceneTable &table, const Names &names, Scene &scene)
{
  const std::vector<Key> common = common_element_keys();
  for (const auto &element : table.tables("element"))
  {
    check_thing_name(element);
    if (names.find_body(element.name()))
      throw element.error("a body has the name '" + element.name() + "' too; their signals would have the same names");
    scene.element_places[element.name()] = element.place();
    const ElementType &type              = type_of(element, element_types(), common);
    type.read(element.declared(type.keys), names, scene);
    if (element.declared(common).choice("initially") == "off")
      begin_off(element, scene);
  }
}

} // namespace gestell::apps
