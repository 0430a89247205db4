// The element "force": external loads from the scene to the motion.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::with;

/// Two sliders of 2 kg and 5 kg that nothing holds, and a rotor; a force between the sliders, a torque on the rotor.
const std::string scene =
    slider_body("left", "2", "[1, 0, 0]") + slider_body("right", "5", "[1, 0, 0]") +
    rotor_body("wheel", "3", "[0, 0, 1]") +
    element("push", "force",
            {{"from", "left"},
             {"to", "right"},
             {"constant", "4 N"},
             {"harmonics",
              "[{ amplitude = '30 N', frequency = '5 Hz', phase = '50 deg' }, { amplitude = 7, frequency = 2 }]"}}) +
    element("drive", "force",
            {{"from", "wheel"}, {"harmonics", "[{ amplitude = '9 N m', frequency = '1 Hz', phase = '90 deg' }]"}}) +
    steps("0.1 ms", "1 s") +
    signals("left = 'left.displacement', right = 'right.displacement', wheel = 'wheel.angle', F = 'push.force', M = "
            "'drive.torque'");

/// Twice integrated from rest:  A sin(w t + p)  ->  A/w^2 (sin p + w t cos p - sin(w t + p)).
double twice(double A, double f, double p, double t)
{
  const double w = 2. * M_PI * f;
  return A / (w * w) * (std::sin(p) + w * t * std::cos(p) - std::sin(w * t + p));
}

TEST(ForceElement, MovesFreeBodiesAsNewtonSays)
{
  const SceneRun motion = run(scene);
  const double   p      = 50. * M_PI / 180.;
  for (const std::size_t row : {1000u, 4321u, 10000u})
  {
    const double t = motion.at(row, 0), impulse = 2. * t * t + twice(30., 5., p, t) + twice(7., 2., 0., t);
    // BDF2: local error h^3/3 x''' summed up, about h^2 omega F/m = 5e-6 of what is summed here.
    EXPECT_NEAR(motion.at(row, 1), impulse / 2., 2e-5) << t;
    EXPECT_NEAR(motion.at(row, 2), -impulse / 5., 1e-5) << t;
    EXPECT_NEAR(motion.at(row, 3), twice(9., 1., M_PI / 2., t) / 3., 1e-5) << t;
  }
}

TEST(ForceElement, IsReadAsASignal)
{
  const SceneRun motion = run(scene);
  for (const std::size_t row : {0u, 777u, 10000u})
  {
    const double t = motion.at(row, 0);
    EXPECT_NEAR(motion.at(row, 4),
                4. + 30. * std::sin(2. * M_PI * 5. * t + 50. * M_PI / 180.) + 7. * std::sin(2. * M_PI * 2. * t), 1e-9);
    EXPECT_NEAR(motion.at(row, 5), 9. * std::cos(2. * M_PI * t), 1e-9);
  }
  EXPECT_EQ(motion.signal("F").unit, "N");
  EXPECT_EQ(motion.signal("M").unit, "N m");
}

TEST(ForceElement, KeepsTheEnergyBalance)
{
  const SceneRun motion = run(scene);
  EXPECT_GT(motion.result.energy.input, 1.);
  EXPECT_LT(motion.result.energy.residual, 1e-4 * motion.result.energy.input);
}

TEST(ForceElement, RefusesWhatMakesNoSense)
{
  expect_complaint(with(scene, "frequency = \"5 Hz\"", "frequency = 0"), "element.push.harmonics[1].frequency");
  expect_complaint(with(scene, "frequency = \"5 Hz\"", "frequency = \"5 rad/s\""), "needs a frequency");
  expect_complaint(with(scene, "amplitude = \"9 N m\"", "amplitude = \"9 N\""), "needs a torque");
  expect_complaint(with(scene, "amplitude = 7", "amplitud = 7"), "unknown key 'amplitud'; did you mean 'amplitude'");
  expect_complaint(with(scene, "amplitude = 7,", "amplitude = 7, delay = 3,"), "unknown key 'delay'");
  expect_complaint(with(scene, "harmonics = [{ amplitude = \"9 N m\", frequency = \"1 Hz\", phase = \"90 deg\" }]", ""),
                   "needs 'constant' or 'harmonics'");
  expect_complaint(with(scene, "[{ amplitude = \"9 N m\", frequency = \"1 Hz\", phase = \"90 deg\" }]", "3"),
                   "needs an array of tables");
}

} // namespace
} // namespace gestell::tests
