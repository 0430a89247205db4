// Newton's method with damping.

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/periodic/newton.h"
#include "tests/support/test.h"

namespace gestell::tests
{
using namespace coupling;
using Eigen::VectorXd;

/// Whole steps for atan z = 0 diverge from |z| > 1.39; the first one leads from 20 to -590, where r is not defined.
TEST(Newton, ShortensStepsUntilTheResidualDecreases)
{
  VectorXd   z      = VectorXd::Constant(1, 20.);
  const auto length = [](const VectorXd &next)
  { return std::abs(next[0]) < 100. ? std::abs(std::atan(next[0])) : throw ConvergenceFailure("not defined"); };
  const auto step = [&](NewtonResult &newton)
  {
    newton.converged = length(z) < 1e-14;
    return newton.converged ? NewtonStep{} : NewtonStep{-z.array().atan() * (1. + z.array().square()), length(z)};
  };

  EXPECT_TRUE(solve_by_newton(z, 20, step, length).converged);
  EXPECT_NEAR(z[0], 0., 1e-14);
}

/// z^2 + 1 = 0 from 1: the first step leads to 0, where there is no next one.
TEST(Newton, StallsAtALeastResidual)
{
  VectorXd           z      = VectorXd::Ones(1);
  const auto         length = [](const VectorXd &next) { return next[0] * next[0] + 1.; };
  const NewtonResult newton = solve_by_newton(
      z, 20,
      [&](NewtonResult &) {
        return NewtonStep{-(z + z.cwiseInverse()) / 2., length(z)};
      },
      length);

  EXPECT_TRUE(newton.stalled);
  EXPECT_EQ(newton.iterations, 1);
  EXPECT_EQ(z[0], 0.);
}

} // namespace gestell::tests
