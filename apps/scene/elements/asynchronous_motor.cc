#include "mechanism/elements/kloss_motor.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_share.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

mechanism::KlossMotor::Parameters read_kloss(const SceneTable &table)
{
  mechanism::KlossMotor::Parameters motor;
  motor.breakdown_torque  = table.positive("breakdown_torque", kind::torque);
  motor.breakdown_slip    = read_share(table, "breakdown_slip");
  motor.synchronous_speed = table.number("synchronous_speed", kind::angular_speed);
  motor.ratio             = table.positive("ratio", kind::number, motor.ratio);
  return motor;
}

/// Measure: angle of the shaft, against the stator.
void read_asynchronous_motor(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto shaft = read_shaft(table, names);
  const auto motor = read_kloss(table);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::KlossMotor>(motor); }), shaft);
}

} // namespace gestell::apps
