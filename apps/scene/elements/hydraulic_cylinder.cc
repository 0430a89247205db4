#include "mechanism/elements/hydraulic_cylinder.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{
const Kind volume{"volume", "2 cm^3", {3, 0, 0}};
const Kind flow{"flow", "20 cm^3/s", {3, 0, -1}};
const Kind leakage{"leakage", "0.1 cm^3/(s bar)", {4, -1, 1}};
} // namespace

/// +F drives u up; the fed lengths are virtual coordinates.
void read_hydraulic_cylinder(const SceneTable &table, const Names &names, Scene &scene)
{
  using mechanism::HydraulicCylinder;
  const auto motion = read_relative_motion(table, names);
  if (motion.rotation)
    throw table.error("a hydraulic cylinder acts along a line, but the motion is an angle; give 'direction', or 'on' a "
                      "distance");
  HydraulicCylinder::Parameters cylinder;
  cylinder.area_a         = table.positive("area_a", kind::area);
  cylinder.area_b         = table.positive("area_b", kind::area, cylinder.area_a);
  cylinder.volume_a       = table.positive("volume_a", volume);
  cylinder.volume_b       = table.positive("volume_b", volume);
  cylinder.zero           = table.number("zero_at", kind::length, 0.);
  cylinder.bulk_modulus   = table.positive("bulk_modulus", kind::pressure, cylinder.bulk_modulus);
  cylinder.pressure_a     = table.number("pressure_a", kind::pressure, 0.);
  cylinder.pressure_b     = table.number("pressure_b", kind::pressure, 0.);
  cylinder.leakage        = table.not_negative("leakage", leakage, 0.);
  const bool        valve = table.has("valve");
  const ProfileKeys keys  = valve ? level_profile(kind::number, "10") : level_profile(flow, flow.example);
  if (valve == table.has("flow"))
    throw table.error("needs 'flow', a level or ramps, or 'valve', its opening from -1 to 1; one of both");
  if (valve)
  {
    cylinder.control    = HydraulicCylinder::Control::valve;
    cylinder.course     = read_course(table, "valve", keys, table.number("initial", kind::number, 0.));
    cylinder.rated_flow = table.positive("rated_flow", flow);
    cylinder.rated_drop = table.positive("rated_drop", kind::pressure);
    cylinder.supply     = table.number("supply_pressure", kind::pressure);
    cylinder.tank       = table.number("tank_pressure", kind::pressure, 0.);
  }
  else
    cylinder.course = read_course(table, "flow", keys, table.number("initial", flow, 0.));
  const std::string name = table.name();
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<HydraulicCylinder>(cylinder); }), motion,
                 {{name + ".fed_a", HydraulicCylinder::lag}, {name + ".fed_b", HydraulicCylinder::lag}});
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
  scene.elements.back().fixed  = true;
}

} // namespace gestell::apps
