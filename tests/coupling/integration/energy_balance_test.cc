#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/system/energy_balance.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

/// Residual at t = 1 of a damped oscillator under a constant load with a viscous local force.
EnergyState balance(double h)
{
  SmallSystem system(Eigen::MatrixXd::Constant(1, 1, 2.), Eigen::MatrixXd::Constant(1, 1, 3.),
                     Eigen::MatrixXd::Constant(1, 1, 500.));
  system.set_law(Eigen::VectorXd::Ones(1),
                 [](double, double v, double &p, double &du, double &dv)
                 {
                   p  = -2. * v;
                   du = 0.;
                   dv = -2.;
                 });
  Bdf           bdf(system, {2, h});
  EnergyBalance energy(system);
  bdf.begin(0., Eigen::VectorXd::Constant(1, 0.1), Eigen::VectorXd::Constant(1, 1.));
  energy.begin(bdf.instant());
  while (bdf.instant().t < 1. - 0.5 * h)
  {
    bdf.advance();
    energy.step(bdf.instant());
  }
  return energy.state(bdf.instant());
}

TEST(EnergyBalance, WhatIsLostFromTheStoreIsDissipated)
{
  const EnergyState state = balance(1e-4);
  EXPECT_EQ(state.input, 0.);
  EXPECT_LT(state.stored, 0.);
  EXPECT_NEAR(state.dissipated, -state.stored, 1e-4 * std::abs(state.stored));
}

TEST(EnergyBalance, ResidualFallsWithTheSecondPowerOfTheStep)
{
  EXPECT_NEAR(std::log2(std::abs(balance(1e-3).residual() / balance(5e-4).residual())), 2., 0.2);
}

// In a step the power changes by 3 %: half of it takes half of the work.
TEST(EnergyBalance, WorkWithinAStepFollowsThePowersAtItsEnds)
{
  SmallSystem   system(Eigen::MatrixXd::Constant(1, 1, 2.), Eigen::MatrixXd::Constant(1, 1, 3.),
                       Eigen::MatrixXd::Constant(1, 1, 500.));
  Bdf           bdf(system, {2, 1e-3});
  EnergyBalance energy(system);
  bdf.begin(0., Eigen::VectorXd::Constant(1, 0.), Eigen::VectorXd::Constant(1, 1.));
  energy.begin(bdf.instant());
  for (int k = 0; k < 5; ++k)
  {
    const double before = energy.state(bdf.instant()).dissipated;
    bdf.advance();
    energy.step(bdf.instant());
    Instant middle = bdf.instant();
    middle.t -= 0.5e-3;
    bdf.interpolate(middle.t, middle.q, middle.v);
    bdf.interpolate(middle.t, middle.local);
    const double within = energy.state(middle).dissipated, after = energy.state(bdf.instant()).dissipated;
    EXPECT_NEAR(within - before, 0.5 * (after - before), 0.03 * (after - before)) << k;
  }
}

} // namespace
} // namespace gestell::tests
