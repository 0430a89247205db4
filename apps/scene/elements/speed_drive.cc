#include "mechanism/elements/speed_drive.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// Measures: angle of the shaft, against the stator; the integral, a lag.
void read_speed_drive(const SceneTable &table, const Names &names, Scene &scene)
{
  const Kind gain{"gain over a speed", "40 N m s/rad", {2, 1, -1}, Counts::turns},
      gain_of_angle{"gain over an angle", "300 N m/rad", {2, 1, -2}};
  const auto                        shaft = read_shaft(table, names);
  mechanism::SpeedDrive::Parameters drive;
  drive.proportional_gain = table.positive("proportional_gain", gain);
  drive.integral_gain     = table.not_negative("integral_gain", gain_of_angle, drive.integral_gain);
  drive.largest_torque    = table.positive("largest_torque", kind::torque, drive.largest_torque);
  const double from       = table.number("initial_speed", kind::angular_speed, 0.);
  drive.speed             = read_free_course(table, "speed", speed_profile(), from);
  const auto element      = checked(table, [&] { return std::make_shared<mechanism::SpeedDrive>(drive); });
  add_element_on(scene, table, element, shaft, {{table.name() + ".integral", element->lag()}});
  scene.elements.back().levels = std::make_shared<ProfileKeys>(speed_profile());
}

} // namespace gestell::apps
