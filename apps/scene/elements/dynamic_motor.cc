#include "mechanism/elements/dynamic_motor.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{

/// Keys of asynchronous motors, stationary or dynamic.
std::vector<Key> kloss_keys();

/// Measures: angle of the shaft, against the stator; the torque, a lag.
void read_dynamic_motor(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto shaft = read_shaft(table, names);
  const auto motor = table.filled<mechanism::KlossMotor::Parameters>();
  if (table.has("time_constant") == table.has("mains_frequency"))
    throw table.error(
        "needs either 'time_constant', with which the torque follows, or 'mains_frequency', from which it "
        "is computed");
  const double lag = table.has("time_constant")
                         ? table.value("time_constant")
                         : 1. / (2. * M_PI * table.value("mains_frequency") * motor.breakdown_slip);
  add_law<mechanism::DynamicMotor>(scene, table, motor, shaft, {{table.name() + ".torque", lag}});
}

ElementType dynamic_motor_type()
{
  return {"dynamic motor",
          "Asynchronous motor whose torque follows the stationary torque with a time constant. Method `bdf` only.",
          "`torque`, `power`, `slip`, `stationary_torque`",
          joined({shaft_keys(),
                  kloss_keys(),
                  {key::number("time_constant", kind::time, "time constant of the torque")
                       .above_zero()
                       .by_default("from `mains_frequency`"),
                   key::number("mains_frequency", kind::frequency,
                               "mains frequency f, for the time constant 1/(2 pi f breakdown_slip)")
                       .above_zero()
                       .by_default("from `time_constant`")}}),
          read_dynamic_motor,
          {R"toml(on                = "crank"           # run-up: the torque builds up with 1/(2 pi 50 Hz 0.15) = 21 ms
breakdown_torque  = "240 N m"
breakdown_slip    = 0.15
synchronous_speed = "1500 1/min"
ratio             = 49
mains_frequency   = "50 Hz"
)toml",
           R"toml(on                = "crank"
breakdown_torque  = "240 N m"
breakdown_slip    = 0.15
synchronous_speed = "1500 1/min"
time_constant     = "20 ms"
)toml"}};
}

} // namespace gestell::apps
