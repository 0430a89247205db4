#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/harmonic/hill.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

} // namespace

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
