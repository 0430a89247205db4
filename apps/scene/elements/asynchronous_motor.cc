#include "mechanism/elements/kloss_motor.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

std::vector<Key> kloss_keys()
{
  using Motor = mechanism::KlossMotor::Parameters;
  return {key::number("breakdown_torque", kind::torque, "largest torque of the motor")
              .above_zero()
              .into(&Motor::breakdown_torque),
          key::number("breakdown_slip", kind::number, "slip at that torque").as_share().into(&Motor::breakdown_slip),
          key::number("synchronous_speed", kind::angular_speed,
                      "synchronous speed of the motor; negative: it runs in reverse")
              .into(&Motor::synchronous_speed),
          key::number("ratio", kind::number, "motor speed / shaft speed").above_zero().by_default(&Motor::ratio)};
}

ElementType asynchronous_motor_type()
{
  return {"asynchronous motor",
          "Asynchronous motor with the stationary torque-slip curve of Kloss.",
          "`torque`, `power`, `slip`",
          joined({shaft_keys(), kloss_keys()}),
          read_law<mechanism::KlossMotor, read_shaft>,
          {R"toml(on                = "crank"
breakdown_torque  = "240 N m"
breakdown_slip    = "15 %"
synchronous_speed = "1500 1/min"
ratio             = 49
)toml"}};
}

} // namespace gestell::apps
