#include "mechanism/elements/gas_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of the piston `from` against `to`.
void read_gas_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion = read_displacement(table, names);
  auto       gas    = table.filled<mechanism::GasForce::Parameters>();
  if (table.has("suction_pressure") != table.has("delivery_pressure"))
    throw table.error(
        "needs 'suction_pressure' and 'delivery_pressure' together, or neither for gas that stays enclosed");
  if (table.has("suction_pressure"))
    gas.valves = {table.value("suction_pressure"), table.value("delivery_pressure")};
  else
    table.demand({"initial_pressure"});
  add_law<mechanism::GasForce>(scene, table, gas, motion);
}

ElementType gas_force_type()
{
  using Gas = mechanism::GasForce::Parameters;
  return {
      "gas force",
      "Polytropic gas force on a piston, with valves that open at two pressures, or enclosed.",
      "`force` along u, `pressure`, `volume`",
      joined({motion_keys(),
              {key::number("area", kind::area, "area of the piston").above_zero().into(&Gas::area),
               key::number("clearance_volume", kind::volume, "volume left at dead centre")
                   .above_zero()
                   .into(&Gas::clearance_volume),
               key::number("dead_centre_at", kind::length, "u at dead centre").by_default(&Gas::dead_centre_at),
               key::choice("side", {"above", "below"}, true,
                           "direction: the volume grows with u (above) or with -u (below)")
                   .into(&Gas::grows, {true, false}),
               key::number("exponent", kind::number, "polytropic exponent").above_zero().by_default(&Gas::exponent),
               key::number("back_pressure", kind::pressure, "pressure on the other side of the piston")
                   .from_zero()
                   .by_default(&Gas::back_pressure),
               key::number("suction_pressure", kind::pressure, "pressure at which the inlet opens")
                   .above_zero()
                   .by_default("no valves"),
               key::number("delivery_pressure", kind::pressure, "pressure at which the outlet opens")
                   .above_zero()
                   .by_default("no valves"),
               key::number("initial_pressure", kind::pressure, "initial pressure; required without valves")
                   .above_zero()
                   .same_as("suction_pressure")
                   .into(&Gas::initial_pressure)}}),
      read_gas_force,
      {R"toml(from              = "slide"          # compressor; a double-acting one has a second with side = "below"
area              = "100 cm^2"
clearance_volume  = "50 cm^3"
dead_centre_at    = "-60 mm"
suction_pressure  = "1 bar"
delivery_pressure = "6 bar"
)toml"}};
}

} // namespace gestell::apps
