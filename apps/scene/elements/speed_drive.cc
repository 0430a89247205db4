#include "mechanism/elements/speed_drive.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

const Kind gain{"gain over a speed", "40 N m s/rad", {2, 1, -1}, Counts::turns};
const Kind gain_of_angle{"gain over an angle", "300 N m/rad", {2, 1, -2}};

} // namespace

/// Measures: angle of the shaft, against the stator; the integral, a lag.
void read_speed_drive(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto   shaft = read_shaft(table, names);
  auto         drive = table.filled<mechanism::SpeedDrive::Parameters>();
  const double from  = table.value("initial_speed");
  drive.input        = read_input(table, "speed", from);
  if (!drive.input)
    drive.speed = read_free_course(table, "speed", speed_profile(), from);
  const auto element = checked(table, [&] { return std::make_shared<mechanism::SpeedDrive>(drive); });
  add_element_on(scene, table, element, shaft, {{table.name() + ".integral", element->lag()}});
  if (!drive.input)
    scene.elements.back().levels = std::make_shared<ProfileKeys>(speed_profile());
}

ElementType speed_drive_type()
{
  using Drive = mechanism::SpeedDrive::Parameters;
  return {
      "speed drive",
      "Speed controller: torque = k_p (setpoint - actual speed) + k_i times the integral of this error, limited, with "
      "anti-windup. Method `bdf` only.",
      "`torque`, `power`, `wanted_speed`, `speed_error`, `integral`",
      joined({shaft_keys(),
              {or_input(course_key("speed", speed_profile(), "speed setpoint: a level, ramps or a function of time")),
               key::number("proportional_gain", gain, "proportional gain k_p")
                   .above_zero()
                   .into(&Drive::proportional_gain),
               key::number("integral_gain", gain_of_angle, "integral gain k_i")
                   .from_zero()
                   .by_default(&Drive::integral_gain),
               key::number("largest_torque", kind::torque, "torque limit, in both directions")
                   .above_zero()
                   .by_default(&Drive::largest_torque),
               key::number("initial_speed", kind::angular_speed, "setpoint before the first ramp").by_default(0.),
               waits_key()}}),
      read_speed_drive,
      {R"toml(on                = "crank"           # run-up without a jerk, and down again
proportional_gain = "200 N m s/rad"
integral_gain     = "4000 N m/rad"
largest_torque    = "2 kN m"
speed = [{ at = "0.1 s", to = "30 1/min", acceleration = "10 rad/s^2", jerk = "200 rad/s^3" },
         { at = "4 s", to = 0, acceleration = "5 rad/s^2" }]
)toml",
       R"toml(on                = "crank"
proportional_gain = "200 N m s/rad"
speed             = { table = [["0 s", 0], ["1 s", 3], ["2 s", 10]], period = "2 s", rise = 10 }
)toml",
       R"toml(on                = "crank"
proportional_gain = "200 N m s/rad"
speed             = { function = "10 rad/s*sin(2*pi*t/(2 s))", period = "2 s" }
)toml",
       R"toml(on                = "crank"
proportional_gain = "200 N m s/rad"
initial_speed     = "30 1/min"
speed             = { input = "w" }
)toml"}};
}

} // namespace gestell::apps
