#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/harmonic/hill.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"

#include <gtest/gtest.h>

#include <complex>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

} // namespace

/// Multipliers of every solution, unstable ones too, as the harmonic balance gives them.
TEST(Hill, HasTheMultipliersOfTheDuffingTable)
{
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
  {
    const DuffingCase    &given   = duffing_cases.at(row["case"]);
    CubicSystem           system  = duffing_system(given);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / given.Omega);
    const PeriodicGuess guess{VectorXd::Constant(1, row.number("x(0)")), VectorXd::Constant(1, row.number("v(0)")), 0.};
    const auto          found = harmonic_balance_method().solve(problem, guess, {});
    ASSERT_EQ(found.at(0).multipliers.size(), 2) << row["case"];
    for (const std::string mu : {"mu1", "mu2"})
    {
      const std::complex<double> value(row.number(mu + "_re"), row.number(mu + "_im"));
      EXPECT_LT((found[0].multipliers.array() - value).abs().minCoeff(), 1e-8) << row["case"] << row["solution"];
    }
    EXPECT_EQ(found[0].stable(), row["stability"] == "stable");
  }
}

TEST(Hill, HasTheMultipliersOfTheTableOfTwoMasses)
{
  for (const ReferenceRow &row : read_reference("periodic/two_dof_shooting.csv"))
  {
    CubicSystem           system  = two_dof_system(row["case"], row.number("Omega"));
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / row.number("Omega"));
    const PeriodicGuess   guess{Eigen::Vector2d(row.number("q1(0)"), row.number("q2(0)")),
                              Eigen::Vector2d(row.number("v1(0)"), row.number("v2(0)")), 0.};
    PeriodicOptions       options;
    options.own["harmonics"] = 16;
    const auto found         = harmonic_balance_method().solve(problem, guess, options);
    ASSERT_EQ(found.at(0).multipliers.size(), 4);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(std::abs(found[0].multipliers[k]), row.number("|mu" + std::to_string(k + 1) + "|"), 1e-8)
          << row["case"] << row["Omega"] << row["solution"];
  }
}

/// A limit cycle has the multiplier 1 of its shift in time, and Liouville's exp(integral of (1 - x^2)) as the other.
TEST(Hill, HasTheTrivialMultiplierOfALimitCycle)
{
  SmallSystem     system  = van_der_pol(1.);
  PeriodicProblem problem = problem_of_period(system, 6.5);
  problem.phase           = 0;
  const auto found = harmonic_balance_method().solve(problem, {VectorXd::Zero(1), VectorXd::Constant(1, 2.), 6.5}, {});
  const PeriodicSolution &cycle = found.at(0);
  ASSERT_EQ(cycle.multipliers.size(), 2);
  EXPECT_TRUE(cycle.trivial_multiplier);
  EXPECT_LT(std::abs(cycle.multipliers[0] - 1.), 1e-8);
  double integral = cycle.period; // of 1, less the mean square of the series
  for (int h = 1; h <= cycle.series->harmonics(); ++h)
    integral -= 0.5 * cycle.period * (std::pow(cycle.series->cosine(0, h), 2) + std::pow(cycle.series->sine(0, h), 2));
  EXPECT_NEAR(cycle.multipliers[1].real(), std::exp(integral), 1e-8);
}

/// Damped modes alone: mu = exp(s T), s = -delta +- i sqrt(omega_0^2 - delta^2).
TEST(Hill, IsExactWhereTheSystemIsLinear)
{
  CubicSystem           system  = duffing_system({0.1, 0., 0.3, 0.8});
  const double          T       = 2. * M_PI / 0.8;
  const PeriodicProblem problem = problem_of_period(system, T);
  HarmonicBalance       balance(problem, 1);
  VectorXd              r;
  MatrixXd              J;
  balance.linearise(balance.linear_start(), r, J);
  const VectorXcd            mu       = hill_multipliers(problem, 0.8, 1, balance.derivatives()).multipliers;
  const std::complex<double> expected = std::exp(std::complex<double>(-0.1, std::sqrt(1. - 0.01)) * T);
  EXPECT_LT((mu.array() - expected).abs().minCoeff(), 1e-12);
}

TEST(Hill, IsChosenForSmallSystemsOnly)
{
  CubicSystem one  = duffing_system(duffing_cases.at("duffing1"));
  SmallSystem many = SmallSystem(MatrixXd::Identity(50, 50), MatrixXd::Identity(50, 50), MatrixXd::Identity(50, 50));
  EXPECT_EQ(floquet_way(problem_of_period(one, 1.), 16), FloquetWay::hill);
  EXPECT_EQ(floquet_way(problem_of_period(many, 1.), 16), FloquetWay::shooting);
}

} // namespace gestell::tests
