// Machines with joints that turn from the first instant: nothing drops, nothing rings.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr double weight_per_kg = 9.81;

/// A slider-crank in a bed on springs, z up.  The bed is a body, so that what holds it shows in its motion.
std::string slider_crank_on_springs(const std::string &start)
{
  return "gravity = [0, 0, -9.81]\n" + planar_body("bed", "400", "60", "[0.4, 0, 0]") +
         revolute("left", "ground", "bed", "[-0.2, 0, -0.3]", {{"stiffness", "2e6 N/m"}}) +
         revolute("right", "ground", "bed", "[1.0, 0, -0.3]", {{"stiffness", "3e6 N/m"}}) +
         planar_body("crank", "30", "2", "[0, 0, 0]") + revolute("'main bearing'", "bed", "crank", "[0, 0, 0]") +
         planar_body("rod", "8", "0.5", "[0.4, 0, 0]") + revolute("'crank pin'", "crank", "rod", "[0.1, 0, 0]") +
         planar_body("slide", "12", "0.1", "[0.9, 0, 0]") + revolute("gudgeon", "rod", "slide", "[0.9, 0, 0]") +
         joint("guide", "prismatic", {{"from", "bed"}, {"to", "slide"}, {"axis", "[1, 0, 0]"}}) + start +
         steps("20 us", "20 us", {{"method", "bdf"}}) +
         signals("az = 'bed.az', ax = 'bed.ax', a_phi = 'bed.acceleration', vz = 'bed.vz', crank = "
                 "'crank.acceleration', w = 'crank.speed'");
}

double first(const SceneRun &motion, int column)
{
  return motion.at(0, std::size_t(column));
}

// From rule "given" the bed falls with g; the steady start has no acceleration but what the mechanism's own forces
// change.
TEST(SteadyStart, ABedOnSpringsCarriesItsJointedMechanismFromTheFirstInstant)
{
  const std::string speed = "v = { \"crank.angle\" = \"300 rpm\" }\n", angle = "q = { \"crank.angle\" = \"70 deg\" }\n";
  const auto        given = run(slider_crank_on_springs("[start]\n" + angle + speed));
  EXPECT_GT(std::hypot(first(given, 1), first(given, 2)), 1.);

  const auto steady = run(slider_crank_on_springs("[start]\nrule = \"steady\"\n" + angle + speed));
  EXPECT_NEAR(first(steady, 1), 0., 1e-7 * weight_per_kg);
  EXPECT_NEAR(first(steady, 2), 0., 1e-7 * weight_per_kg);
  EXPECT_NEAR(first(steady, 3), 0., 1e-7 * weight_per_kg);
  EXPECT_NEAR(first(steady, 4), 0., 1e-12);
  EXPECT_NEAR(first(steady, 6), 10. * M_PI, 1e-12);
  EXPECT_GT(std::abs(first(steady, 5)), 1.); // nothing drives: weight and inertia of rod and slide accelerate the crank
}

// A crank on a stiff foundation accelerates as d/dt of the kinetic energy says: J(phi) phi'' + 1/2 J' phi'^2 = Q.
TEST(SteadyStart, WhatNoDriveHoldsAcceleratesAsTheMechanismDoes)
{
  const std::string rules = "q = { \"crank.angle\" = \"70 deg\" }\nv = { \"crank.angle\" = \"300 rpm\" }\n";
  std::string       scene = slider_crank_on_springs("[start]\n" + rules);
  const auto        begin = scene.find("[joint.left]"), end = scene.find("[body.crank]");
  scene.replace(begin, end - begin, joint("foot", "rigid", "ground", "bed", "[0, 0, 0]"));
  const double alpha = first(run(scene), 5);
  std::string  soft  = slider_crank_on_springs("[start]\nrule = \"steady\"\n" + rules);
  for (const std::string stiffness : {"\"2e6 N/m\"", "\"3e6 N/m\""})
    soft.replace(soft.find(stiffness), stiffness.size(), "\"1e12 N/m\"");
  EXPECT_NEAR(first(run(soft), 5), alpha, 1e-5 * std::abs(alpha));
}

// A bar that turns at omega opens its compliant pin by e = m omega^2 r/(k - m omega^2) and stays so.  The start knows e
// to its first order in e/r, for what deflects has the velocities of the rigid machine; closed pins would ring from 0
// to 2 k e.
TEST(SteadyStart, ACompliantPinIsOpenByWhatTheTurningBarPullsWith)
{
  const double m = 2., r = 0.4, omega = 10.;
  for (const double k : {1e4, 1e5, 1e6})
  {
    const double e      = m * omega * omega * r / (k - m * omega * omega);
    const auto   motion = run(R"(
[body.bar]
type = "planar"
normal = [0, 1, 0]
inertia = 0.1
mass = 2
position = [0.4, 0, 0]
[joint.pin]
from = "ground"
to = "bar"
at = [0, 0, 0]
type = "revolute"
stiffness = )" + std::to_string(k) +
                              "\n" + start("rule = 'steady'\nv = { 'bar.angle' = 10 }") + steps("0.1 ms", "0.1 s") +
                              signals("F = 'pin.resultant', x = 'bar.ux'"));
    EXPECT_NEAR(first(motion, 2), e, 1.1 * e * e / r);
    EXPECT_NEAR(motion.signal("F").min, k * e, 3. * k * e * e / r);
    EXPECT_NEAR(motion.signal("F").max, k * e, 3. * k * e * e / r);
  }
}

TEST(SteadyStart, OfARotorAtAGivenAngleLeavesNothingToSolve)
{
  const auto motion = run(rotor_body("fan", "0.5", "[0, 0, 1]") +
                          start("rule = 'steady'\ndriver = 'fan'\nangles = { fan = 0.5 }\nspeeds = { fan = 3.0 }") +
                          steps("1 ms", "1 ms") + signals("a = 'fan.angle', w = 'fan.speed'"));
  EXPECT_EQ(first(motion, 1), 0.5);
  EXPECT_EQ(first(motion, 2), 3.);
}

TEST(SteadyStart, RefusesSpeedsThatJointsMakeDependOnEachOther)
{
  const auto starts = [](const std::string &state)
  { return [=] { run(slider_crank_on_springs(start("rule = 'steady'") + state + "\n")); }; };
  EXPECT_THROW(starts("v = { 'rod.angle' = 1, 'slide.ux' = 0.2, 'crank.angle' = 10 }")(), std::invalid_argument);
  expect_refusal(starts("v = { 'crank.angle' = 0, 'rod.angle' = 0 }"), "depend on each other");
  expect_refusal(starts("q = { 'crank.angle' = 1 }"), "needs the speed");
}

} // namespace
} // namespace gestell::tests
