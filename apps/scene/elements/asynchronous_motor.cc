#include "mechanism/elements/kloss_motor.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

mechanism::KlossMotor::Parameters read_kloss(const SceneTable &table)
{
  mechanism::KlossMotor::Parameters motor;
  motor.breakdown_torque  = table.value("breakdown_torque");
  motor.breakdown_slip    = table.value("breakdown_slip");
  motor.synchronous_speed = table.value("synchronous_speed");
  motor.ratio             = table.value("ratio");
  return motor;
}

std::vector<Key> kloss_keys()
{
  const mechanism::KlossMotor::Parameters own;
  return {key::number("breakdown_torque", kind::torque, "largest torque of the motor").above_zero(),
          key::number("breakdown_slip", kind::number, "slip at that torque").as_share(),
          key::number("synchronous_speed", kind::angular_speed, "of the motor; negative: it runs backwards"),
          key::number("ratio", kind::number, "motor speed / shaft speed").above_zero().by_default(own.ratio)};
}

/// Measure: angle of the shaft, against the stator.
void read_asynchronous_motor(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto shaft = read_shaft(table, names);
  const auto motor = read_kloss(table);
  add_law<mechanism::KlossMotor>(scene, table, motor, shaft);
}

ElementType asynchronous_motor_type()
{
  return {"asynchronous motor",
          "Stationary torque over slip, after Kloss.",
          "`torque`, `power`, `slip`",
          joined({shaft_keys(), kloss_keys()}),
          read_asynchronous_motor,
          {R"toml(on                = "crank"
breakdown_torque  = "240 N m"
breakdown_slip    = "15 %"
synchronous_speed = "1500 1/min"
ratio             = 49
)toml"}};
}

} // namespace gestell::apps
