// Ideal joints, run with a tolerance of 1e-8: laws that follow a rate have no more to go by than joints leave of it,
// and dry friction has dead points to pass.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

// A bar turns about its end, J = 1.5e-3 + 0.2 (0.1^2 + 0.2^2), against bristles that come to R within R/(sigma_0 w), 7
// us and less.  Momentum:  J (w_0 - w) = int (sigma_0 z + sigma_1 z') dt = R t - R^2/(sigma_0 w_0) + sigma_1 R/sigma_0.
using Bristles = ::testing::TestWithParam<double>;

TEST_P(Bristles, OfWhichAnAngleLeavesMoreRoundingThanTheToleranceNeedNoStepsOfTheirOwn)
{
  const double   sigma_0 = GetParam();
  const SceneRun motion  = run(
       planar_body("bar", "0.2 kg", "1.5e-3 kg m^2", "['0.1 m', 0, '-0.2 m']") +
           revolute("pin", "ground", "bar", "[0, 0, 0]") +
           measure("turn", "angle", {{"from", "bar"}, {"about", "[0, 1, 0]"}}) +
           element(
               "bristle", "lugre friction",
               {{"on", "turn"}, {"kinetic_force", "0.13"}, {"bristle_stiffness", "2000"}, {"bristle_damping", "0.1"}}) +
           start("v = { 'bar.angle' = '9 rad/s' }") + R"([run]
method = "bdf"
tolerance = 1e-8
end = "0.2 s"
)" + signals("w = 'bar.speed', F = 'bristle.force'"),
       {"element.bristle.bristle_stiffness=" + std::to_string(sigma_0)});
  const double J = 0.0115, R = 0.13, sigma_1 = 0.1, w_0 = 9.;
  EXPECT_NEAR(motion.signal("w").final, w_0 - (R * 0.2 - R * R / (sigma_0 * w_0) + sigma_1 * R / sigma_0) / J, 1e-6);
  EXPECT_NEAR(motion.signal("F").final, R, 1e-6 * R);
  expect_closed_balance(motion, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Stiffnesses, Bristles, ::testing::Values(2e3, 3e4, 3e6)); // N m/rad

// Started at a slip of 4.7, a motor's torque hardly depends on the speed, 2 M_K s_K/s^2 per slip; where it comes
// through its synchronous speed the law is a thousand times as steep, 2 M_K/s_K, and so is what rounding of the speed
// makes of the torque.
TEST(ControlledJoints, CarryAMotorThroughTheSteepPartOfItsLaw)
{
  const SceneRun motion =
      run(rotor_body("b1", "0.28", "[1, 0, 0]") + rotor_body("b2", "0.0958", "[1, 0, 0]") +
          element("spring1", "spring-damper",
                  {{"from", "b1"}, {"to", "ground"}, {"stiffness", "4187"}, {"damping", "1.658"}}) +
          element("spring2", "spring-damper",
                  {{"from", "b2"}, {"to", "ground"}, {"stiffness", "460.1"}, {"damping", "0.09867"}}) +
          joint("gear", "gear", {{"from", "b1"}, {"to", "b2"}, {"ratio", "-1.378"}}) +
          element("motor", "dynamic motor",
                  {{"on", "b1"},
                   {"ratio", "2.212"},
                   {"breakdown_torque", "167.7"},
                   {"breakdown_slip", "0.117"},
                   {"synchronous_speed", "8.98"},
                   {"time_constant", "7.295 ms"}}) +
          start("v = { b1 = -14.97 }") + R"([run]
method = "bdf"
tolerance = 1e-8
end = "1.012 s"
)" + signals("w1 = 'b1.speed', w2 = 'b2.speed'"));
  expect_closed_balance(motion, 1e-6);
  EXPECT_NEAR(motion.signal("w2").final, -1.378 * motion.signal("w1").final, 1e-6);
}

const std::string coasting_crank =
    planar_body("crank", "2 kg", "0.5 kg m^2", "['0.05 m', 0, 0]") +
    planar_body("rod", "1 kg", "0.02 kg m^2", "['0.35 m', 0, 0]") +
    slider_body("piston", "2 kg", "[1, 0, 0]", {{"position", "['0.6 m', 0, 0]"}}) +
    revolute("main", "ground", "crank", "[0, 0, 0]") + revolute("pin", "crank", "rod", "['0.1 m', 0, 0]") +
    revolute("wrist", "rod", "piston", "['0.6 m', 0, 0]") +
    element("rub", "dry friction", {{"from", "piston"}, {"kinetic_force", "20 N"}, {"static_force", "30 N"}}) +
    R"([start]
q = { "crank.angle" = 0.7 }
v = { "crank.angle" = "10 rad/s" }
[run]
method = "bdf"
tolerance = 1e-8
end = "1 s"
)" + signals("w = 'crank.speed', phi = 'crank.angle', F = 'rub.force'");

using DeadPoints = ::testing::TestWithParam<Settings>;

// At a dead point the piston rests and the crank does not: joints alone stop it, friction cannot, and turns with the
// motion.  So friction takes 20 N times the way of the piston, 0.2 m between two dead points.
TEST_P(DeadPoints, ArePassedByACrankWhosePistonRubs)
{
  const SceneRun motion = run(coasting_crank, GetParam());
  const auto   x = [](double phi) { return 0.1 * std::cos(phi) + std::sqrt(0.25 - std::pow(0.1 * std::sin(phi), 2)); };
  const double end = motion.signal("phi").final;
  ASSERT_TRUE(end > 2. * M_PI && end < 3. * M_PI);
  EXPECT_EQ(count(motion, "stick"), 2);
  EXPECT_EQ(motion.result.events.size(), 2u);
  const double way = x(0.7) - x(M_PI) + 0.2 + x(0.) - x(end);
  EXPECT_NEAR(motion.result.energy.dissipated, 20. * way, 1e-4 * 20. * way); // fixed steps: h^2 w^2 = 1e-6 a step
  EXPECT_NEAR(motion.signal("F").max, 20., 1e-9);
  EXPECT_NEAR(motion.signal("F").min, -20., 1e-9);
  EXPECT_LT(std::abs(motion.result.energy.residual), 1e-3 * 20. * way);
}
INSTANTIATE_TEST_SUITE_P(Methods, DeadPoints,
                         ::testing::Values(Settings{}, Settings{"run.tolerance=1e-5"},
                                           Settings{"run={step=\"0.1 ms\", end=\"1 s\"}"},
                                           Settings{"run={method=\"generalised-alpha\", rho_inf=0.8, step=\"0.1 ms\", "
                                                    "end=\"1 s\"}"}));

} // namespace
} // namespace gestell::tests
