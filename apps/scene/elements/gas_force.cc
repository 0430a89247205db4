#include "mechanism/elements/gas_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measure: displacement of the piston `from` against `to`.
void read_gas_force(const SceneTable &table, const Names &names, Scene &scene)
{
  const Kind                      volume{"volume", "50 cm^3", {3, 0, 0}};
  const auto                      motion = read_relative_motion(table, names);
  mechanism::GasForce::Parameters gas;
  if (motion.rotation)
    throw table.error("acts along a displacement, not on an angle; name a slider in 'from' or give 'direction'");
  gas.area             = table.positive("area", kind::area);
  gas.clearance_volume = table.positive("clearance_volume", volume);
  gas.dead_centre_at   = table.number("dead_centre_at", kind::length, gas.dead_centre_at);
  gas.exponent         = table.positive("exponent", kind::number, gas.exponent);
  gas.back_pressure    = table.not_negative("back_pressure", kind::pressure, gas.back_pressure);
  gas.grows            = table.choice("side", {"above", "below"}, "above") == "above";
  if (table.has("suction_pressure") != table.has("delivery_pressure"))
    throw table.error(
        "needs 'suction_pressure' and 'delivery_pressure' together, or neither for gas that stays enclosed");
  if (table.has("suction_pressure"))
    gas.valves = {table.positive("suction_pressure", kind::pressure),
                  table.positive("delivery_pressure", kind::pressure)};
  gas.initial_pressure = gas.valves ? table.positive("initial_pressure", kind::pressure, gas.valves->suction)
                                    : table.positive("initial_pressure", kind::pressure);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::GasForce>(gas); }), motion);
}

} // namespace gestell::apps
