// Ideal joints with controlled steps: errors follow the tolerance.

#include "tests/support/scene_motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

namespace gestell::tests
{
namespace
{

std::string tolerance(double value)
{
  std::ostringstream text;
  text << "run.tolerance=" << value;
  return text.str();
}

const std::string pendulum = R"toml(
gravity = [0, 0, -10]
[body.bar]
type = "planar"
normal = [0, 1, 0]
mass = "2 kg"
inertia = "0.1 kg m^2"
position = [0, 0, "-0.5 m"]
[joint.pin]
type = "revolute"
from = "ground"
to = "bar"
at = [0, 0, 0]
[start]
q = { "bar.angle" = 2 }
[run]
step = "50 ms"
tolerance = 1e-6
end = "3 s"
[output]
step = "0.1 s"
picture_step = 0
)toml";

/// phi'' = -w^2 sin(phi) by Runge and Kutta; its error is of h^4, 1e-13 here.
std::array<double, 2> angle_and_speed(double t)
{
  const double  w2 = 2. * 10. * 0.5 / (0.1 + 2. * 0.25);
  constexpr int n  = 40000;
  const double  h  = t / n;
  double        x = 2., v = 0.;
  const auto    a = [w2](double phi) { return -w2 * std::sin(phi); };
  for (int i = 0; i < n; ++i)
  {
    const double k1 = v, l1 = a(x), k2 = v + 0.5 * h * l1, l2 = a(x + 0.5 * h * k1), k3 = v + 0.5 * h * l2,
                 l3 = a(x + 0.5 * h * k2), k4 = v + h * l3, l4 = a(x + h * k3);
    x += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
    v += h / 6. * (l1 + 2. * l2 + 2. * l3 + l4);
  }
  return {x, v};
}

TEST(ControlledJoints, ErrorsOfThePendulumFollowTheTolerance)
{
  const auto exact  = angle_and_speed(3.);
  double     before = 0., steps_before = 0.;
  for (const double tol : {1e-4, 1e-6, 1e-8})
  {
    const SceneRun motion = run(pendulum + "signals = { phi = \"bar.angle\", w = \"bar.speed\" }\n", {tolerance(tol)});
    ASSERT_EQ(motion.result.failure, "");
    const double error = std::max(std::abs(motion.signal("phi").final - exact[0]) / 2.,
                                  std::abs(motion.signal("w").final - exact[1]) / 8.);
    // Some three swings: each adds the tolerance a few times.
    EXPECT_LT(error, 50. * tol) << tol;
    if (before > 0.)
    {
      EXPECT_LT(error, before / 10.) << tol;
    }
    const double steps = double(motion.result.work.steps);
    RecordProperty("steps_" + std::to_string(int(-std::log10(tol))), std::to_string(steps));
    RecordProperty("error_" + std::to_string(int(-std::log10(tol))), std::to_string(error / tol));
    EXPECT_GT(steps, steps_before);
    before = error, steps_before = steps;
  }
}

// The force of the pin by hand: of the mass on its circle, m (l phi'^2 + g cos(phi)) along the bar.
TEST(ControlledJoints, MultipliersAreAsAccurateAsTheMotion)
{
  const auto   exact = angle_and_speed(3.);
  const double l = 0.5, along = 2. * (l * exact[1] * exact[1] + 10. * std::cos(exact[0])),
               across = 2. * 10. * std::sin(exact[0]) * (1. - 2. * l * l / (0.1 + 2. * l * l));
  double before       = 0.;
  for (const double tol : {1e-5, 1e-7})
  {
    const SceneRun motion = run(pendulum + "signals = { N = \"pin.resultant\" }\n", {tolerance(tol)});
    ASSERT_EQ(motion.result.failure, "");
    const double error = std::abs(motion.signal("N").final / std::hypot(along, across) - 1.);
    EXPECT_LT(error, 100. * tol) << tol;
    if (before > 0.)
    {
      EXPECT_LT(error, before / 10.) << tol;
    }
    before = error;
  }
}

// Directors and the equations that keep them rigid: the same pendulum as a body in space.
TEST(ControlledJoints, OfABodyInSpaceMoveItAsOneInAPlane)
{
  const auto with = [](std::string scene, const std::string &piece, const std::string &replacement)
  { return scene.replace(scene.find(piece), piece.size(), replacement); };
  std::string space          = with(pendulum, "\"planar\"\nnormal = [0, 1, 0]", "\"rigid\"");
  space                      = with(space, "inertia = \"0.1 kg m^2\"", "inertia = [0.1, 0.1, 0.01]");
  space                      = with(space, "at = [0, 0, 0]\n", "at = [0, 0, 0]\naxis = [0, 1, 0]\n");
  space                      = with(space, "\"bar.angle\" = 2", "\"bar.ry\" = 2");
  const std::string signals  = "signals = { x = \"bar.ux\", z = \"bar.uz\" }\n";
  const SceneRun    in_plane = run(pendulum + signals, {tolerance(1e-8)}),
                 in_space    = run(space + signals, {tolerance(1e-8)});
  ASSERT_EQ(in_space.result.failure, "");
  EXPECT_NEAR(in_space.signal("x").final, in_plane.signal("x").final, 50. * 1e-8);
  EXPECT_NEAR(in_space.signal("z").final, in_plane.signal("z").final, 50. * 1e-8);
}

const std::string slider_crank = R"toml(
[body.crank]
type = "rotor"
axis = [0, 1, 0]
inertia = "0.5 kg m^2"
position = [0, 0, 0]
[body.rod]
type = "planar"
normal = [0, 1, 0]
mass = "1 kg"
inertia = "0.02 kg m^2"
position = [0, 0, "0.35 m"]
[body.ram]
type = "slider"
axis = [0, 0, 1]
mass = "2 kg"
position = [0, 0, "0.6 m"]
[joint.pin]
type = "revolute"
from = "crank"
to = "rod"
at = [0, 0, "0.1 m"]
[joint.wrist]
type = "revolute"
from = "rod"
to = "ram"
at = [0, 0, "0.6 m"]
[start]
v = { crank = 30 }
[run]
step = "20 ms"
tolerance = 1e-6
end = "0.5 s"
[output]
picture_step = 0
signals = { angle = "crank.angle", w = "crank.speed", F = "pin.resultant" }
)toml";

TEST(ControlledJoints, ErrorsOfTheSliderCrankFollowTheTolerance)
{
  const SceneRun best = run(slider_crank, {tolerance(1e-10)});
  ASSERT_EQ(best.result.failure, "");
  double before = 0.;
  for (const double tol : {1e-4, 1e-6, 1e-8})
  {
    const SceneRun motion = run(slider_crank, {tolerance(tol)});
    ASSERT_EQ(motion.result.failure, "");
    double error = 0.;
    for (const char *name : {"angle", "w", "F"})
      error = std::max(error, std::abs(motion.signal(name).final / best.signal(name).final - 1.));
    EXPECT_LT(error, 50. * tol) << tol;
    if (before > 0.)
    {
      EXPECT_LT(error, before / 10.) << tol;
    }
    before = error;
    EXPECT_LT(std::abs(motion.result.energy.residual), 100. * tol * 0.5 * 0.5 * 900.);
  }
}

// Dry friction with controlled steps: the events are those of the closed form.
TEST(ControlledJoints, StickAndLetGoWhereTheyShould)
{
  const SceneRun motion = run(R"toml(
gravity = [0, 0, -10]
[body.carriage]
type = "planar"
normal = [0, 1, 0]
mass = "3 kg"
inertia = "0.02 kg m^2"
position = [0, 0, 0]
[joint.guide]
type = "prismatic"
from = "ground"
to = "carriage"
at = [0, 0, 0]
axis = [1, 0, 0]
friction = { law = "dry", coefficient = 0.2, static = 0.4 }
[element.pull]
type = "formula force"
from = "carriage"
direction = [1, 0, 0]
force = "10 N/s*t"
[start]
v = { "carriage.ux" = -1 }
[run]
step = "50 ms"
tolerance = 1e-8
end = "1.5 s"
[output]
picture_step = 0
signals = { v = "carriage.vx", F = "guide.friction" }
)toml");
  ASSERT_EQ(motion.result.failure, "");
  // -3 + 6 t + 5 t^2 = 0, then 10 t = 0.4 * 30.
  EXPECT_NEAR(time_of(motion, "stick"), (-6. + std::sqrt(36. + 60.)) / 10., 1e-7);
  EXPECT_NEAR(time_of(motion, "slip_forward"), 1.2, 1e-7);
  EXPECT_NEAR(motion.signal("v").final, (5. * (2.25 - 1.44) - 6. * 0.3) / 3., 1e-6);
}

} // namespace
} // namespace gestell::tests
