// Ideal joints with controlled steps: errors follow the tolerance.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"
#include "tests/support/tilted_planes.h"

namespace gestell::tests
{
namespace
{

std::string tolerance(double value)
{
  return "run.tolerance=" + number(value);
}

const std::string settings = steps("50 ms", "3 s") + "[output]\nstep = '0.1 s'\npicture_step = 0\n";

const std::string held_pendulum =
    "gravity = [0, 0, -10]\n" + planar_body("bar", "2 kg", "0.1 kg m^2", "[0, 0, '-0.5 m']") +
    revolute("pin", "ground", "bar", "[0, 0, 0]") + start("q = { 'bar.angle' = 2 }") + settings;

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
    const SceneRun motion =
        run(held_pendulum + "signals = { phi = \"bar.angle\", w = \"bar.speed\" }\n", {tolerance(tol)});
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
// Lengths by 1e-3, times by the root of it: the same angles in as many steps.
TEST(ControlledJoints, OfHalfAMillimetreSwingAsThoseOfHalfAMetre)
{
  for (const std::string tolerance : {"1e-8", "1e-10"})
  {
    const SceneRun large = run(double_pendulum(0.6, tolerance)), small = run(double_pendulum(0.6e-3, tolerance));
    for (const char *angle : {"phi", "psi"})
      EXPECT_NEAR(small.signal(angle).final, large.signal(angle).final, 1e3 * std::stod(tolerance)) << angle;
    EXPECT_NEAR(double(small.result.work.steps) / double(large.result.work.steps), 1., 0.1);
  }
}

TEST(ControlledJoints, MultipliersAreAsAccurateAsTheMotion)
{
  const auto   exact = angle_and_speed(3.);
  const double l = 0.5, along = 2. * (l * exact[1] * exact[1] + 10. * std::cos(exact[0])),
               across = 2. * 10. * std::sin(exact[0]) * (1. - 2. * l * l / (0.1 + 2. * l * l));
  double before       = 0.;
  for (const double tol : {1e-5, 1e-7})
  {
    const SceneRun motion = run(held_pendulum + "signals = { N = \"pin.resultant\" }\n", {tolerance(tol)});
    const double   error  = std::abs(motion.signal("N").final / std::hypot(along, across) - 1.);
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
  const std::string space =
      "gravity = [0, 0, -10]\n" + rigid_body("bar", "2 kg", "[0.1, 0.1, 0.01]", "[0, 0, '-0.5 m']") +
      revolute("pin", "ground", "bar", "[0, 0, 0]", {{"axis", "[0, 1, 0]"}}) + start("q = { 'bar.ry' = 2 }") + settings;
  const std::string signals  = "signals = { x = \"bar.ux\", z = \"bar.uz\" }\n";
  const SceneRun    in_plane = run(held_pendulum + signals, {tolerance(1e-8)}),
                 in_space    = run(space + signals, {tolerance(1e-8)});
  EXPECT_NEAR(in_space.signal("x").final, in_plane.signal("x").final, 50. * 1e-8);
  EXPECT_NEAR(in_space.signal("z").final, in_plane.signal("z").final, 50. * 1e-8);
}

const std::string slider_crank = rotor_body("crank", "0.5 kg m^2", "[0, 1, 0]", {{"position", "[0, 0, 0]"}}) +
                                 planar_body("rod", "1 kg", "0.02 kg m^2", "[0, 0, '0.35 m']") +
                                 slider_body("ram", "2 kg", "[0, 0, 1]", {{"position", "[0, 0, '0.6 m']"}}) +
                                 revolute("pin", "crank", "rod", "[0, 0, '0.1 m']") +
                                 revolute("wrist", "rod", "ram", "[0, 0, '0.6 m']") + start("v = { crank = 30 }") +
                                 steps("20 ms", "0.5 s") +
                                 signals("angle = 'crank.angle', w = 'crank.speed', F = 'pin.resultant'");

TEST(ControlledJoints, ErrorsOfTheSliderCrankFollowTheTolerance)
{
  const SceneRun best   = run(slider_crank, {tolerance(1e-10)});
  double         before = 0.;
  for (const double tol : {1e-4, 1e-6, 1e-8})
  {
    const SceneRun motion = run(slider_crank, {tolerance(tol)});
    double         error  = 0.;
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

} // namespace
} // namespace gestell::tests
