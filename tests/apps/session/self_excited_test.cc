// Machines that nothing tells the time: what they do by themselves, and planar bodies that turn.

#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

PeriodicResult steady(const std::string &text, const std::string &method = "")
{
  PeriodicRequest request{method};
  return periodic_of(text, request);
}

/// x'' - mu (1 - x^2) x' + x = 0
std::string van_der_pol(const std::string &force)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1"}}) +
         element("drive", "formula force", {{"from", "slide"}, {"force", force}}) +
         test::quoted("[output.signals]\nx = 'slide.displacement'\n");
}

/// A crank as planar body on a pin, driven by a torque that falls with its speed, with rod and ram.
std::string planar_crank(double torque, double rpm)
{
  return "gravity = [0, 0, -9.81]\n" + planar_body("crank", "2", "0.5", "[0.05, 0, 0]") +
         planar_body("rod", "1", "0.02", "[0.4, 0, 0]") +
         slider_body("ram", "3", "[1, 0, 0]", {{"position", "[0.7, 0, 0]"}}) +
         revolute("O", "ground", "crank", "[0, 0, 0]") + revolute("A", "crank", "rod", "[0.1, 0, 0]") +
         revolute("B", "rod", "ram", "[0.7, 0, 0]") +
         element("motor", "formula force",
                 {{"from", "crank"},
                  {"to", "ground"},
                  {"about", "[0, 1, 0]"},
                  {"force", number(torque) + " N*m - 2 N*m*s/rad*v"}}) +
         start("v = { 'crank.angle' = '" + number(rpm) + " rpm' }") + steps("0.5 ms", "1 s", {{"method", "bdf"}}) +
         "[output.signals]\nx = \"ram.displacement\"\n";
}

} // namespace

/// A branch that begins with the few harmonics of mu = 0.2 ends with those that mu = 4 needs: its period is that of
/// shooting there.
TEST(SelfExcitedScene, HarmonicsAreAddedAlongABranch)
{
  const std::string text = "[parameters]\nmu = 0.2\n" + van_der_pol("mu*(1 N*s/m - 1 N*s/m^3*u^2)*v");
  PeriodicRequest   request{"harmonic-balance"};
  request.along              = "parameters.mu";
  request.from               = "0.2";
  request.to                 = "4";
  request.points             = 10;
  const PeriodicResult along = periodic_of(text, request);
  ASSERT_EQ(along.failure, "");
  const PeriodicEntry &first = along.entries.front(), &last = along.entries.back();
  EXPECT_GT(last.solution.series->harmonics(), first.solution.series->harmonics());
  EXPECT_DOUBLE_EQ(last.parameter, 4.);
  PeriodicRequest shot;
  shot.method               = "shooting";
  const PeriodicResult here = periodic_of(text, shot, {"parameters.mu=4"});
  ASSERT_EQ(here.entries.size(), 1u) << here.failure;
  EXPECT_NEAR(last.solution.period, here.entries[0].solution.period, 1e-8);
  EXPECT_NEAR(last.signals[0].max, here.entries[0].signals[0].max, 1e-7);
}

/// With too few harmonics for the corners of mu = 9 the motion is known to 3e-4, and a period that starts there does
/// not close: multipliers are those of the one near by that does.
TEST(SelfExcitedScene, ARelaxationOscillationIsStableByHarmonicBalanceToo)
{
  const PeriodicResult result = steady(van_der_pol("9*(1 N*s/m - 1 N*s/m^3*u^2)*v"), "harmonic-balance");
  ASSERT_EQ(result.entries.size(), 1u) << result.failure;
  EXPECT_TRUE(result.entries[0].solution.stable());
  EXPECT_NEAR(result.entries[0].solution.period, 17.5521775, 1e-5); // by shooting
}

/// What turns has no extreme within a turn: its signal goes from the begin of the period to its end, 2 pi farther.
TEST(SelfExcitedScene, AngleOfASeriesThatTurnsEndsWithTheTurn)
{
  const std::string text =
      test::quoted("[body.rotor]\ntype = 'rotor'\naxis = [0, 1, 0]\ninertia = '1 kg m^2'\n") +
      element("motor", "formula force",
              {{"from", "rotor"}, {"force", "20 N*m - 2 N*m*s/rad*v + 8 N*m*sin(u + 1 rad)"}}) +
      test::quoted("[start]\nv = { rotor = '10 rad/s' }\n[output.signals]\nphi = 'rotor.angle'\nw = 'rotor.speed'\n");
  const PeriodicResult shot = steady(text, "shooting"), balanced = steady(text, "harmonic-balance");
  ASSERT_EQ(shot.entries.size(), 1u) << shot.failure;
  ASSERT_EQ(balanced.entries.size(), 1u) << balanced.failure;
  const auto &phi = balanced.entries[0].signals[0];
  EXPECT_NEAR(phi.max - phi.min, 2. * M_PI, 1e-8);
  EXPECT_NEAR(balanced.entries[0].signals[1].max, shot.entries[0].signals[1].max, 1e-7);
}

/// Stick and slip on a belt of speed v_b: with a = (R0 - R)/k and b = v_b/w,
///
///     T = (2 pi - 2 atan2(a, b))/w + 2 a/v_b,     largest x = R/k + sqrt(a^2 + b^2).
///
/// The period begins where nothing sticks, so that all motions of a branch do, along springs and along the belt.
TEST(SelfExcitedScene, StickAndSlipOnABeltIsItsClosedSolutionAlongABranch)
{
  const double      R = 2., R0 = 3.;
  const std::string text =
      "[parameters]\nk = 100\nvb = 0.1\n" + slider_body("slide", "1", "[1, 0, 0]") +
      element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "k*(1 N/m)"}}) +
      element("belt", "dry friction",
              {{"from", "slide"}, {"kinetic_force", "2"}, {"static_force", "3"}, {"speed", "vb*(1 m/s)"}}) +
      test::quoted("[output.signals]\nx = 'slide.displacement'\n");
  struct Case
  {
    std::string along, from, to;
  };
  for (const Case &one : {Case{"k", "100", "150"}, Case{"k", "150", "100"}, Case{"vb", "0.1", "0.2"}})
  {
    PeriodicRequest request{"shooting"};
    request.along               = "parameters." + one.along;
    request.from                = one.from;
    request.to                  = one.to;
    request.points              = 10;
    const PeriodicResult result = periodic_of(text, request);
    EXPECT_EQ(result.failure, "");
    EXPECT_TRUE(result.special_points.empty()) << one.along;
    EXPECT_NEAR(result.entries.back().parameter, std::stod(one.to), 1e-12);
    for (const PeriodicEntry &entry : result.entries)
    {
      const double k = one.along == "k" ? entry.parameter : 100., vb = one.along == "vb" ? entry.parameter : 0.1;
      const double w = std::sqrt(k), a = (R0 - R) / k, b = vb / w;
      EXPECT_NEAR(entry.solution.period, (2. * M_PI - 2. * std::atan2(a, b)) / w + 2. * a / vb, 1e-8);
      EXPECT_NEAR(entry.signals[0].max, R / k + std::hypot(a, b), 1e-8);
    }
  }
}

/// The period is longer by mu^2/16 of it in second order, of which averaging knows nothing.
TEST(SelfExcitedScene, AveragingReportsWhatItLeavesOutOfThePeriod)
{
  const std::string    begin  = "[run]\nbegin = '10 s'\nend = '20 s'\nmethod = 'exact'\nstep = '10 ms'\n";
  const PeriodicResult result = steady(van_der_pol("(1 N*s/m - 1 N*s/m^3*u^2)*v") + test::quoted(begin), "averaging");
  ASSERT_EQ(result.entries.size(), 1u) << result.failure;
  EXPECT_THAT(result.entries[0].solution.notes.back(),
              testing::HasSubstr("by 0.16 of its amplitude and by 0.061 of its period"));
}

/// Published to many digits for mu = 1: period 6.6632868593231, largest displacement 2.0086198608748.  From rest, which
/// is an equilibrium, and by four methods, the last of which passes its phase falling too.
TEST(SelfExcitedScene, VanDerPolsOscillatorKeepsItsPublishedPeriod)
{
  for (const std::string method : {"shooting", "settling", "harmonic-balance", "minimise"})
  {
    const PeriodicResult result = steady(van_der_pol("(1 N*s/m - 1 N*s/m^3*u^2)*v"), method);
    ASSERT_EQ(result.entries.size(), 1u) << method << result.failure;
    EXPECT_NEAR(result.entries[0].solution.period, 6.6632868593231, 1e-8) << method;
    EXPECT_NEAR(result.entries[0].signals[0].max, 2.0086198608748, 1e-8) << method;
    EXPECT_TRUE(result.entries[0].solution.stable()) << method;
  }
}

/// What loses its energy has no motion of its own but rest.
TEST(SelfExcitedScene, AMachineThatComesToRestIsSaidTo)
{
  expect_refusal([] { steady(van_der_pol("-0.1 N*s/m*v")); }, "comes to rest");
}

/// Negative damping that nothing limits has no periodic motion; no damping has one of any size.
TEST(SelfExcitedScene, WhatGrowsWithoutEndOrKeepsAnySizeIsSaidTo)
{
  expect_refusal([] { steady(van_der_pol("0.1 N*s/m*v")); }, "without limit");
  expect_refusal([] { steady(van_der_pol("0 N*s/m*v")); }, "amplitude of its oscillation is that of its initial state");
}

/// Crank and rod are planar bodies, of which one turns and one swings; backwards the machine is its own mirror image,
/// at the same speed.  Steps of 0.5 ms leave a relative 1e-6 of the period.
TEST(SelfExcitedScene, APlanarCrankCompletesARevolutionInBothDirections)
{
  const PeriodicResult forward = steady(planar_crank(20., 95.)), backward = steady(planar_crank(-20., -95.));
  ASSERT_EQ(forward.entries.size(), 1u) << forward.failure;
  ASSERT_EQ(backward.entries.size(), 1u) << backward.failure;
  EXPECT_NEAR(forward.entries[0].solution.period, 0.6286341, 1e-5);
  EXPECT_NEAR(backward.entries[0].solution.period, forward.entries[0].solution.period, 1e-6);
  EXPECT_NEAR(forward.entries[0].solution.turn.maxCoeff(), 2. * M_PI, 0.);
  EXPECT_NEAR(backward.entries[0].solution.turn.minCoeff(), -2. * M_PI, 0.);
  EXPECT_EQ((forward.entries[0].solution.turn.array() != 0.).count(), 1) << "the rod swings";
}

} // namespace gestell::tests
