// Ropes, contacts after Hertz, sliding friction and gas: from the scene to the motion, against solutions by hand.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;

using Bodies = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, Bodies, ::testing::Values(fixed, controlled));

// --- rope

TEST_P(Bodies, OnARopeFlyFreelyWhileItIsSlack)
{
  // 2 kg pulled by 20 N along the rope, thrown back with 1 m/s: free for 2 m v/F, then half a swing about F/c.
  Settings settings = GetParam();
  settings.push_back("run.energy=true");
  const SceneRun motion = run(
      slider(2., "1 s") + "F = 'rope.force'\n" + element("load", "force", {{"from", "slide"}, {"constant", "20 N"}}) +
          element("rope", "rope", {{"from", "slide"}, {"stiffness", "2 kN/m"}}) + start("v = { slide = '-1 m/s' }"),
      settings);
  const double omega = std::sqrt(2000. / 2.), d = 0.01, R = std::hypot(d, 1. / omega);
  const double free = 0.2, taut = 2. * (M_PI - std::acos(d / R)) / omega;
  ASSERT_GE(count(motion, "slack"), 3);
  for (int n = 0; n < 3; ++n)
  {
    EXPECT_NEAR(time_of(motion, "taut", n), free + n * (free + taut), 1e-5);
    EXPECT_NEAR(time_of(motion, "slack", n), (n + 1) * (free + taut), 1e-5);
  }
  EXPECT_NEAR(motion.signal("F").max, 2000. * (d + R), 0.01);
  EXPECT_GE(motion.signal("F").min, -1e-6);
  EXPECT_NEAR(motion.result.energy.dissipated, 0., 1e-4);
}

// --- contact after Hertz

TEST_P(Bodies, AgainstABallBearIndentAsHertzSays)
{
  Settings settings = GetParam();
  settings.push_back("run.step=0.5 us");
  const SceneRun motion =
      run(slider(0.5, "2 ms") + "F = 'ball.force'\n" +
              element("ball", "stop", {{"from", "slide"}, {"stiffness", "5e9"}, {"exponent", "1.5"}}) +
              start("v = { slide = '2 m/s' }"),
          settings);
  const double c = 5e9, depth = std::pow(2.5 * 0.5 * 0.5 * 4. / c, 1. / 2.5);
  EXPECT_NEAR(motion.signal("x").max, depth, 5e-5 * depth); // 560 steps in contact
  EXPECT_NEAR(motion.signal("F").max, c * std::pow(depth, 1.5), 5e-5 * c * std::pow(depth, 1.5));
  // 2 d/v times the integral of dx/sqrt(1 - x^2.5) over (0, 1).
  const double contact = 2. * depth / 2. * std::sqrt(M_PI) * std::tgamma(1.4) / std::tgamma(0.9);
  EXPECT_NEAR(time_of(motion, "separation"), contact, 1e-4 * contact);
  EXPECT_NEAR(motion.signal("v").final, -2., 1e-4);
}

// --- friction

TEST_P(Bodies, SlideToAStopOnAStribeckCurve)
{
  // m v' = -(R + D exp(-v/v_s)): with y = exp(v/v_s), y' = -(R y + D)/(m v_s).
  const SceneRun motion = run(
      slider(2., "0.5 s") +
          element(
              "joint", "dry friction",
              {{"from", "slide"}, {"kinetic_force", "4 N"}, {"static_force", "6 N"}, {"stribeck_speed", "0.1 m/s"}}) +
          start("v = { slide = '0.6 m/s' }"),
      GetParam());
  const double stop = 2. * 0.1 / 4. * std::log((std::exp(6.) + 0.5) / 1.5);
  EXPECT_NEAR(time_of(motion, "stick"), stop, 1e-7);
  EXPECT_NEAR(motion.signal("v").final, 0., 1e-12);
}

const std::string bristles = "F = 'joint.force'\n" +
                             element("load", "force", {{"from", "slide"}, {"constant", "3 N"}}) +
                             element("joint", "lugre friction",
                                     {{"from", "slide"},
                                      {"kinetic_force", "4 N"},
                                      {"static_force", "6 N"},
                                      {"stribeck_speed", "0.01 m/s"},
                                      {"bristle_stiffness", "100 N/mm"},
                                      {"bristle_damping", "400 N s/m"}});

TEST_P(Bodies, HeldByBristlesGiveWayLikeASpring)
{
  const SceneRun motion = run(slider(2., "0.5 s") + bristles, GetParam());
  EXPECT_NEAR(motion.signal("F").final, 3., 1e-3);
  // 30 um of the spring, and the little that bristles slip on the way: |v| z sigma_0/R, below half of it at F = R/2.
  EXPECT_GT(motion.signal("x").final, 30e-6);
  EXPECT_LT(motion.signal("x").final, 60e-6);
  expect_closed_balance(motion, 1e-3);
}

TEST_P(Bodies, ThatBreakAwayFromTheirBristlesSlideWithTheKineticForce)
{
  // A slow pull finds the static force; beyond it m v' = 10 N/s t - R(v).
  Settings settings = GetParam();
  settings.push_back("element.load={ type = \"force profile\", from = \"slide\", profile = [{ at = 0, to = 10, rate = "
                     "10 }] }");
  const SceneRun motion = run(slider(2., "1 s") + bristles, settings);
  EXPECT_NEAR(motion.signal("F").final, 4., 1e-6);
  EXPECT_GT(motion.signal("F").max, 5.5);
  EXPECT_LT(motion.signal("F").max, 6.);
  const double free = 0.6; // from F = R0 on, and less resistance than that
  EXPECT_GT(motion.signal("v").final, 0.5 * 10. * (1. - free * free) / 2. - 6. * (1. - free) / 2.);
  EXPECT_LT(motion.signal("v").final, 0.5 * 10. * (1. - 0.5 * 0.5) / 2. - 4. * (1. - 0.5) / 2.);
  expect_closed_balance(motion, 1e-3);
}

// --- forming

TEST_P(Bodies, DrawASheetAsFarAsTheirEnergyGoesAndAreThrownBackByItsElasticPart)
{
  Settings settings = GetParam();
  settings.push_back("run.step=2 us");
  const SceneRun motion = run(slider(50., "60 ms") +
                                  element("sheet", "drawing force",
                                          {{"from", "slide"},
                                           {"force", "20 kN"},
                                           {"stiffness", "40 kN/mm"},
                                           {"contact_at", "5 mm"},
                                           {"depth", "30 mm"}}) +
                                  start("v = { slide = '2 m/s' }"),
                              settings);
  const double   rise = 0.5e-3, drawn = (100. - 0.5 * 2e4 * rise) / 2e4;
  EXPECT_NEAR(motion.signal("x").max, 5e-3 + rise + drawn, 1e-8);
  EXPECT_NEAR(motion.signal("v").final, -2e4 / std::sqrt(4e7 * 50.), 1e-5);
  EXPECT_NEAR(motion.result.energy.dissipated, 2e4 * drawn, 1e-3 * 2e4 * drawn);
  EXPECT_EQ(count(motion, "flow_begins"), 1);
}

// --- gas

TEST_P(Bodies, AgainstEnclosedGasTurnBackWhereTheirEnergyIsSpent)
{
  Settings settings = GetParam();
  settings.push_back("run.step=10 us");
  const SceneRun motion = run(slider(2., "60 ms") + "P = 'gas.pressure'\n" +
                                  element("gas", "gas force",
                                          {{"from", "slide"},
                                           {"side", "below"},
                                           {"area", "100 cm^2"},
                                           {"clearance_volume", "50 cm^3"},
                                           {"dead_centre_at", "100 mm"},
                                           {"initial_pressure", "1 bar"},
                                           {"back_pressure", "1 bar"},
                                           {"exponent", "1.4"}}) +
                                  start("v = { slide = '8 m/s' }"),
                              settings);
  const double   V_0 = 0.00105, K = 1e5 * std::pow(V_0, 1.4);
  const auto energy = [&](double V) { return K / 0.4 * (std::pow(V, -0.4) - std::pow(V_0, -0.4)) + 1e5 * (V - V_0); };
  double     low = 5e-5, high = V_0;
  for (int i = 0; i < 60; ++i)
    (energy(0.5 * (low + high)) > 64. ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(motion.signal("x").max, (V_0 - low) / 0.01, 1e-6);
  EXPECT_NEAR(motion.signal("P").max, K * std::pow(low, -1.4), 1e-3 * K * std::pow(low, -1.4));
  EXPECT_NEAR(motion.result.energy.dissipated, 0., 1e-3);
}

TEST(GasForce, RefusesWhatMakesNoSense)
{
  const std::string scene = slider(2., "60 ms") + element("gas", "gas force",
                                                          {{"from", "slide"},
                                                           {"area", "100 cm^2"},
                                                           {"clearance_volume", "50 cm^3"},
                                                           {"suction_pressure", "1 bar"},
                                                           {"delivery_pressure", "6 bar"}});
  EXPECT_EQ(complaint(scene), "");
  expect_complaint(scene, "above the suction pressure", {"element.gas.delivery_pressure=0.5 bar"});
  expect_complaint(scene, "needs an area", {"element.gas.area=1 m"});
  expect_complaint(scene, "volume", {"element.gas.clearance_volume=1 m^2"});
}

} // namespace
} // namespace gestell::tests
