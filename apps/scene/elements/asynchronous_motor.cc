#include "mechanism/elements/kloss_motor.h"

#include "apps/scene/relative_motion.h"

namespace gestell::apps
{

mechanism::KlossMotor::Parameters read_kloss(const SceneTable &table)
{
  mechanism::KlossMotor::Parameters motor;
  motor.breakdown_torque  = table.positive("breakdown_torque", kind::torque);
  motor.breakdown_slip    = table.positive("breakdown_slip", kind::number);
  motor.synchronous_speed = table.number("synchronous_speed", kind::angular_speed);
  motor.ratio             = table.positive("ratio", kind::number, motor.ratio);
  return motor;
}

/// Measure: angle of the rotor about its own axis, against the stator.
void read_asynchronous_motor(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motor = read_kloss(table);
  add_element(scene, table, checked(table, [&] { return std::make_shared<mechanism::KlossMotor>(motor); }),
              {motor_angle(table, names, scene)});
}

} // namespace gestell::apps
