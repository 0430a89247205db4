// Ideal joints, run with a tolerance of 1e-8: laws that follow a rate have no more to go by than joints leave of it,
// and dry friction has dead points to pass.

#include "scene_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

// A bar turns about its end, J = 1.5e-3 + 0.2 (0.1^2 + 0.2^2), against bristles that come to R within R/(sigma_0 w) =
// 7 us.  Momentum:  J (w_0 - w) = int (sigma_0 z + sigma_1 z') dt = R t - R^2/(sigma_0 w_0) + sigma_1 R/sigma_0.
TEST(ControlledJoints, CarryBristlesOfWhichAnAngleLeavesMoreRoundingThanTheToleranceAtShortSteps)
{
  const SceneRun motion = run(R"toml(
[body.bar]
type = "planar"
normal = [0, 1, 0]
mass = "0.2 kg"
inertia = "1.5e-3 kg m^2"
position = ["0.1 m", 0, "-0.2 m"]
[joint.pin]
type = "revolute"
from = "ground"
to = "bar"
at = [0, 0, 0]
[measure.turn]
type = "angle"
from = "bar"
about = [0, 1, 0]
[element.bristle]
type = "lugre friction"
on = "turn"
kinetic_force = 0.13
bristle_stiffness = 2000
bristle_damping = 0.1
[start]
v = { "bar.angle" = "9 rad/s" }
[run]
method = "bdf"
tolerance = 1e-8
end = "0.2 s"
[output]
signals = { w = "bar.speed", F = "bristle.force" }
)toml");
  ASSERT_EQ(motion.result.failure, "");
  const double J = 0.0115, R = 0.13, sigma_0 = 2000., sigma_1 = 0.1, w_0 = 9.;
  EXPECT_NEAR(motion.signal("w").final, w_0 - (R * 0.2 - R * R / (sigma_0 * w_0) + sigma_1 * R / sigma_0) / J, 1e-6);
  EXPECT_NEAR(motion.signal("F").final, R, 1e-6 * R);
  expect_closed_balance(motion, 1e-6);
}

// Started at a slip of 4.7, a motor's torque hardly depends on the speed, 2 M_K s_K/s^2 per slip; where it comes
// through its synchronous speed the law is a thousand times as steep, 2 M_K/s_K, and so is what rounding of the speed
// makes of the torque.
TEST(ControlledJoints, CarryAMotorThroughTheSteepPartOfItsLaw)
{
  const SceneRun motion = run(R"toml(
[body.b1]
type = "rotor"
axis = [1, 0, 0]
inertia = 0.28
[body.b2]
type = "rotor"
axis = [1, 0, 0]
inertia = 0.0958
[element.spring1]
type = "spring-damper"
from = "b1"
to = "ground"
stiffness = 4187
damping = 1.658
[element.spring2]
type = "spring-damper"
from = "b2"
to = "ground"
stiffness = 460.1
damping = 0.09867
[joint.gear]
type = "gear"
from = "b1"
to = "b2"
ratio = -1.378
[element.motor]
type = "dynamic motor"
on = "b1"
ratio = 2.212
breakdown_torque = 167.7
breakdown_slip = 0.117
synchronous_speed = 8.98
time_constant = "7.295 ms"
[start]
v = { b1 = -14.97 }
[run]
method = "bdf"
tolerance = 1e-8
end = "1.012 s"
[output]
signals = { w1 = "b1.speed", w2 = "b2.speed" }
)toml");
  expect_closed_balance(motion, 1e-6);
  EXPECT_NEAR(motion.signal("w2").final, -1.378 * motion.signal("w1").final, 1e-6);
}

} // namespace
} // namespace gestell::tests
