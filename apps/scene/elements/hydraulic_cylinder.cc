#include "mechanism/elements/hydraulic_cylinder.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{
const Kind flow{"flow", "20 cm^3/s", {3, 0, -1}};
const Kind leakage{"leakage", "0.1 cm^3/(s bar)", {4, -1, 1}};
} // namespace

/// +F drives u up; the fed lengths are virtual coordinates.
void read_hydraulic_cylinder(const SceneTable &table, const Names &names, Scene &scene)
{
  using mechanism::HydraulicCylinder;
  const auto motion = read_relative_motion(table, names);
  if (motion.rotation)
    throw table.error(
        "a hydraulic cylinder acts along a line, but the motion is an angle; give 'direction', or 'on' a distance");
  auto              cylinder = table.filled<HydraulicCylinder::Parameters>();
  const bool        valve    = table.has("valve");
  const ProfileKeys keys     = valve ? level_profile(kind::number, "10") : level_profile(flow, flow.example);
  if (valve == table.has("flow"))
    throw table.error("needs 'flow', a level or ramps, or 'valve', its opening from -1 to 1; one of both");
  if (valve)
  {
    cylinder.control = HydraulicCylinder::Control::valve;
    cylinder.course  = read_course(table, "valve", keys, table.number("initial", kind::number, 0.));
    table.demand({"rated_flow", "rated_drop", "supply_pressure"});
  }
  else
    cylinder.course = read_course(table, "flow", keys, table.number("initial", flow, 0.));
  const std::string name = table.name();
  add_law<HydraulicCylinder>(scene, table, cylinder, motion,
                             {{name + ".fed_a", HydraulicCylinder::lag}, {name + ".fed_b", HydraulicCylinder::lag}});
  scene.elements.back().levels = std::make_shared<ProfileKeys>(keys);
  scene.elements.back().fixed  = true;
}

ElementType hydraulic_cylinder_type()
{
  using Cylinder = mechanism::HydraulicCylinder::Parameters;
  return {
      "hydraulic cylinder",
      "Two oil columns between a piston and its barrel, fed by a flow or a valve; method bdf only. A static start "
      "finds the pressures of closed columns. Nothing ends its stroke and pressures may fall below zero, of which you "
      "are warned with the time: put a \"stop\" where the oil columns end, and give enough pressure.",
      "`force` that drives u up, `pressure_a`, `pressure_b`, `flow` into A, `stroke`",
      joined(
          {motion_keys(),
           {key::number("area_a", kind::area, "of the piston in chamber A, u growing as it is filled")
                .above_zero()
                .into(&Cylinder::area_a),
            key::number("area_b", kind::area, "in chamber B").above_zero().same_as("area_a").into(&Cylinder::area_b),
            key::number("volume_a", kind::volume, "of the oil in A where u = zero_at")
                .above_zero()
                .into(&Cylinder::volume_a),
            key::number("volume_b", kind::volume, "of the oil in B there").above_zero().into(&Cylinder::volume_b),
            key::number("zero_at", kind::length, "u to which volumes and pressures belong").by_default(&Cylinder::zero),
            key::number("bulk_modulus", kind::pressure, "of the oil").above_zero().by_default(&Cylinder::bulk_modulus),
            key::number("pressure_a", kind::pressure, "at zero_at").by_default(&Cylinder::pressure_a),
            key::number("pressure_b", kind::pressure, "at zero_at").by_default(&Cylinder::pressure_b),
            key::number("leakage", leakage, "past the piston, a flow by pressure")
                .from_zero()
                .by_default(&Cylinder::leakage),
            profile_key("flow", level_profile(flow, flow.example),
                        "into A, while B gives back what the piston displaces: a level or ramps")
                .by_default("`valve`"),
            profile_key("valve", level_profile(kind::number, "10"), "opening from -1 to 1: a level or ramps")
                .by_default("`flow`"),
            key::number("initial", flow, "flow, or opening, before the first ramp").by_default(0.),
            key::number("rated_flow", flow, "of the open valve; with `valve`")
                .above_zero()
                .by_default("")
                .only_with("valve")
                .into(&Cylinder::rated_flow),
            key::number("rated_drop", kind::pressure, "of pressure per edge at that flow; with `valve`")
                .above_zero()
                .by_default("")
                .only_with("valve")
                .into(&Cylinder::rated_drop),
            key::number("supply_pressure", kind::pressure, "of the pump; with `valve`")
                .by_default("")
                .only_with("valve")
                .into(&Cylinder::supply),
            key::number("tank_pressure", kind::pressure, "behind the valve")
                .by_default(&Cylinder::tank)
                .only_with("valve"),
            waits_key()}}),
      read_hydraulic_cylinder,
      {R"toml(from     = "slide"
area_a   = "20 cm^2"
volume_a = "100 cm^3"
volume_b = "100 cm^3"
flow     = [{ at = "0.1 s", to = "20 cm^3/s", rate = "100 cm^3/s/s" }]
)toml",
       R"toml(from            = "slide"
area_a          = "20 cm^2"
volume_a        = "100 cm^3"
volume_b        = "100 cm^3"
valve           = [{ at = "0.1 s", to = 1, rate = "10/s" }]
rated_flow      = "500 cm^3/s"
rated_drop      = "35 bar"
supply_pressure = "200 bar"
)toml"}};
}

} // namespace gestell::apps
