// What the residual of the energy balance is measured against, and what it says of a run.

#include "coupling/simulation/energy_guard.h"
#include "fem/values/two_pi.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Verdict = EnergyGuard::Verdict;

/// A slider of 1 kg and 1 Hz, that starts with 1 m/s: 0.5 J.
RunResult oscillation(double step, double end)
{
  Machine machine = spring_and_mass(1., two_pi * two_pi);
  return simulate(machine, start(0., 1.), run_of(bdf(2, step), end), {});
}

/// Share of the energy that numerical damping takes, docs/theory/integration.md (11): ratio (omega h)^4/4 per step.
double lost_share(double step, double end)
{
  return 1. - std::exp(-2. * std::pow(two_pi * step, 4) / 4. * end / step);
}

TEST(EnergyGuard, AnOscillatorThatKeepsItsEnergyIsNotAnOpenBalance)
{
  const RunResult result = oscillation(1. / 200, 10.);
  EXPECT_EQ(result.failure, "");
  EXPECT_TRUE(result.findings.empty()) << result.findings[0].text;
  EXPECT_NEAR(result.energy.exchanged, 0.5, 1e-3);
  EXPECT_NEAR(result.energy.residual, 0.5 * lost_share(1. / 200, 10.), 0.03 * result.energy.residual); // h^2 terms
}

TEST(EnergyGuard, NumericalDampingIsAWarningWithItsShare)
{
  for (const double end : {10., 300.}) // 6 % of the energy is lost, then nearly all
  {
    const RunResult result = oscillation(1. / 50, end);
    const double    share  = lost_share(1. / 50, end);
    EXPECT_EQ(result.failure, "");
    EXPECT_NEAR(result.energy.residual / result.energy.exchanged, share, 0.05 * share) << end;
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_NE(result.findings[0].text.find("numerical dissipation: BDF 2 with a step of 0.02 s is too coarse"),
              std::string::npos)
        << result.findings[0].text;
    EXPECT_NE(result.findings[0].text.find("% of the 0.5 J exchanged by the motion"), std::string::npos)
        << result.findings[0].text;
  }
}

TEST(EnergyGuard, AMachineThatHangsAtRestHasNothingToExchange)
{
  MachineModel model;
  model.set_gravity({0., 0., -9.81});
  const int z = model.add_slider("m", {0., 0., 1.}, 3., "ground");
  model.add_linear("spring", {{z, 1.}}, {700., 0., 0., 0.}, "N");
  Machine         machine(std::move(model));
  const double    sag    = -3. * 9.81 / 700.; // rounded: not quite at rest
  const RunResult result = simulate(machine, start(sag, 0.), run_of(bdf(2, 1e-3), 5.), {});
  EXPECT_EQ(result.failure, "");
  EXPECT_TRUE(result.findings.empty()) << result.findings[0].text;
}

TEST(EnergyGuard, SpuriousEnergyIsNotAMotion)
{
  EnergyGuard guard;
  EnergyState state;
  for (int k = 0; k < 200; ++k) // doubles every ten steps, and nothing drives
  {
    state.stored = state.kinetic = std::pow(2., 0.1 * k);
    guard.step(state, 1.);
  }
  EXPECT_EQ(guard.verdict(), Verdict::no_motion);
  EXPECT_NE(guard.words("BDF 3").find("a spurious energy gain: BDF 3; the result is not physical"), std::string::npos);
}

TEST(EnergyGuard, WorkThatGoesThroughIsTheMeasureOfADrivenMachine)
{
  // 1 J in and out in each of 1000 steps, of which 2 mJ go astray: 0.2 % of the work, but twice the energy it holds.
  EnergyGuard guard;
  EnergyState state;
  for (int k = 0; k < 1000; ++k)
  {
    state.input += 1.;
    state.dissipated += 0.998;
    guard.step(state, 1.);
  }
  EXPECT_NEAR(guard.residual(), 2., 1e-9);
  EXPECT_NEAR(guard.exchanged(), 1998., 1e-9);
  EXPECT_EQ(guard.verdict(), Verdict::closed);
  EXPECT_EQ(guard.words("BDF 2"), "");
}

TEST(EnergyGuard, WhatALoadGivesAndTakesBackIsNotWorkThatGoesThrough)
{
  // 1 J in and out in each of 1000 periods, of which a thousandth is lost every time: all of the joule in the end.
  EnergyGuard guard;
  EnergyState state;
  for (int k = 0; k < 1000; ++k)
    for (const double input : {1., 0.})
    {
      state.input  = input;
      state.stored = input - 1e-3 * k;
      guard.step(state, 1.);
    }
  EXPECT_NEAR(guard.exchanged(), 1., 1e-9);
  EXPECT_EQ(guard.verdict(), Verdict::open);
}

TEST(EnergyGuard, AnEnergyThatIsNotANumberEndsTheRun)
{
  for (double EnergyState::*part : {&EnergyState::input, &EnergyState::stored, &EnergyState::dissipated})
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    {
      EnergyGuard guard;
      EnergyState state;
      guard.step(state, 1.);
      state.*part = value;
      EXPECT_THROW(guard.step(state, 1.), ConvergenceFailure);
    }
}

TEST(EnergyGuard, RoundingOfManyStepsIsNotAnError)
{
  EnergyGuard guard;
  EnergyState state;
  state.forces = 1e6; // at 10 m: 2e-9 J a step
  for (int k = 0; k < 1000; ++k)
  {
    state.stored = -1e-9 * k;
    guard.step(state, 10.);
  }
  EXPECT_EQ(guard.verdict(), Verdict::closed);
  state.stored = -1e-2;
  guard.step(state, 10.);
  EXPECT_EQ(guard.verdict(), Verdict::open); // it is lost, not more than there was
}

} // namespace
} // namespace gestell::tests
