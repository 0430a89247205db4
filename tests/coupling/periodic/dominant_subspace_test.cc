#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int    n_masses = 30;
constexpr double drive    = 0.35; ///< [rad/s], near the lowest frequency

/// A chain of masses, damped as its stiffness so that high modes die away, with a cubic spring at its end.
SmallSystem chain(double beta)
{
  MatrixXd C = MatrixXd::Zero(n_masses, n_masses);
  for (int i = 0; i < n_masses; ++i)
  {
    C(i, i) += 8.;
    if (i + 1 < n_masses)
    {
      C(i, i) += 8.;
      C(i, i + 1) = C(i + 1, i) = -8.;
    }
  }
  const MatrixXd M = MatrixXd::Identity(n_masses, n_masses);
  SmallSystem    system(M, 0.06 * C + 0.01 * M, C);
  system.set_law(VectorXd::Unit(n_masses, n_masses - 1), law_of([beta](double u) { return -beta * u * u * u; },
                                                                [beta](double u) { return -3. * beta * u * u; }));
  system.loads().add_harmonic(n_masses - 1, drive, 0.9, 0.);
  return system;
}

PeriodicProblem slow_problem_of(SmallSystem &system)
{
  return problem_of_period(system, 2. * M_PI / drive);
}

} // namespace

/// Newton's method with the tangents of slow motions alone comes to the same motion as with all, and finds the same
/// largest multipliers, from a few passages instead of one for each of 60 tangents.
TEST(DominantSubspace, LeadToTheMotionAndMultipliersOfAll)
{
  SmallSystem           system  = chain(0.7);
  const PeriodicProblem problem = slow_problem_of(system);
  DominantSubspace      motions(problem);
  ASSERT_TRUE(mostly_fast(motions, problem));
  PeriodicOptions     options;
  const VectorXd      rest = VectorXd::Zero(n_masses);
  const PeriodicGuess guess{rest, rest, 0.};
  const auto          slow = shoot_slow(problem, motions, guess, options);
  ShootingEquations   equations(problem, options.integration);
  PeriodicGuess       near = guess;
  lead_in(equations.flow(), problem, options, near);
  const auto all = shoot(equations, problem, equations.unknowns(near.q, near.v, near.period), options);
  EXPECT_LT((slow.q - all.q).norm(), 1e-9 * all.q.norm());
  EXPECT_LT((slow.v - all.v).norm(), 1e-9 * all.v.norm());
  ASSERT_GE(slow.multipliers.size(), 2);
  ASSERT_LT(slow.multipliers.size(), all.multipliers.size());
  // A residual of 1e-8 moves the eigenvalue of a matrix that is not normal by a few times as much.
  EXPECT_NEAR(std::abs(slow.multipliers[0]), std::abs(all.multipliers[0]), 1e-7);
  EXPECT_NEAR(std::abs(slow.multipliers[1]), std::abs(all.multipliers[1]), 1e-7);
}

/// Of the linear chain the fast block is exact: one step closes the motion, and the multipliers are those of its modes.
TEST(DominantSubspace, CloseALinearMotionInOneStep)
{
  SmallSystem           system  = chain(0.);
  const PeriodicProblem problem = slow_problem_of(system);
  PeriodicOptions       options;
  options.own["lead-in"] = 0;
  DominantSubspace motions(problem);
  ASSERT_TRUE(mostly_fast(motions, problem));
  const VectorXd rest  = VectorXd::Zero(n_masses);
  const auto     found = shoot_slow(problem, motions, {rest, rest, 0.}, options);
  EXPECT_LE(found.work.iterations, 2); // one with coarse steps, one for what those left
  const auto modes   = modal_blocks(system);
  double     slowest = -1e300;
  for (int b = 0; b < modes.n_modal; ++b)
    slowest = std::max(slowest, modes.blocks[std::size_t(b)].s);
  EXPECT_NEAR(found.largest_multiplier(), std::exp(slowest * problem.period), 1e-9);
}

/// Driven so slowly that all motions die away within a period: none is above the share, and the slowest is carried
/// still.
TEST(DominantSubspace, CarryTheSlowestWhereAllDieAway)
{
  SmallSystem     system  = chain(0.7);
  PeriodicProblem problem = slow_problem_of(system);
  problem.period *= 40.; // forty periods of the load
  problem.ratio = 40;
  DominantSubspace motions(problem);
  ASSERT_TRUE(mostly_fast(motions, problem));
  EXPECT_EQ(motions.size(), 2);
  const VectorXd    rest  = VectorXd::Zero(n_masses);
  const auto        found = shoot_slow(problem, motions, {rest, rest, 0.}, {});
  ShootingEquations equations(problem, PeriodicOptions().integration);
  equations.evaluate(equations.unknowns(found.q, found.v, 0.), true);
  EXPECT_LT(equations.closing(), 1e-9);
  ASSERT_GE(found.multipliers.size(), 1);
  EXPECT_NEAR(found.largest_multiplier(), equations.solution("").largest_multiplier(), 1e-7);
}
