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
        "a hydraulic cylinder acts along a line, but this measure is an angle; give 'direction', or 'on' a length");
  auto              cylinder = table.filled<HydraulicCylinder::Parameters>();
  const bool        valve    = table.has("valve");
  const ProfileKeys keys     = valve ? level_profile(kind::number, "10") : level_profile(flow, flow.example);
  if (valve == table.has("flow"))
    throw table.error("needs either 'flow' (a level or ramps) or 'valve' (opening from -1 to 1)");
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
      "Hydraulic cylinder: two oil columns fed by a flow or a valve. Method `bdf` only. A static initial state "
      "includes the pressures of closed columns. The stroke has no end and pressures may fall below zero; a warning "
      "gives the time. Add a \"stop\" where the oil columns end, and enough pressure.",
      "`force` in the direction of growing u, `pressure_a`, `pressure_b`, `flow` into A, `stroke`",
      joined({motion_keys(),
              {key::number("area_a", kind::area, "piston area of chamber A; u grows as A is filled")
                   .above_zero()
                   .into(&Cylinder::area_a),
               key::number("area_b", kind::area, "piston area of chamber B")
                   .above_zero()
                   .same_as("area_a")
                   .into(&Cylinder::area_b),
               key::number("volume_a", kind::volume, "oil volume in A at u = `zero_at`")
                   .above_zero()
                   .into(&Cylinder::volume_a),
               key::number("volume_b", kind::volume, "oil volume in B at u = `zero_at`")
                   .above_zero()
                   .into(&Cylinder::volume_b),
               key::number("zero_at", kind::length, "u at which volumes and pressures are given")
                   .by_default(&Cylinder::zero),
               key::number("bulk_modulus", kind::pressure, "bulk modulus of the oil")
                   .above_zero()
                   .by_default(&Cylinder::bulk_modulus),
               key::number("pressure_a", kind::pressure, "pressure in A at u = `zero_at`")
                   .by_default(&Cylinder::pressure_a),
               key::number("pressure_b", kind::pressure, "pressure in B at u = `zero_at`")
                   .by_default(&Cylinder::pressure_b),
               key::number("leakage", leakage, "leakage past the piston, flow per pressure")
                   .from_zero()
                   .by_default(&Cylinder::leakage),
               profile_key("flow", level_profile(flow, flow.example),
                           "flow into A, while B returns the displaced oil: a level or ramps")
                   .by_default("`valve`"),
               profile_key("valve", level_profile(kind::number, "10"), "valve opening from -1 to 1: a level or ramps")
                   .by_default("`flow`"),
               key::number("initial", flow, "flow or valve opening before the first ramp").by_default(0.),
               key::number("rated_flow", flow, "rated flow of the open valve; with `valve`")
                   .above_zero()
                   .by_default("")
                   .only_with("valve")
                   .into(&Cylinder::rated_flow),
               key::number("rated_drop", kind::pressure, "pressure drop per edge at the rated flow; with `valve`")
                   .above_zero()
                   .by_default("")
                   .only_with("valve")
                   .into(&Cylinder::rated_drop),
               key::number("supply_pressure", kind::pressure, "supply pressure of the pump; with `valve`")
                   .by_default("")
                   .only_with("valve")
                   .into(&Cylinder::supply),
               key::number("tank_pressure", kind::pressure, "tank pressure")
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
