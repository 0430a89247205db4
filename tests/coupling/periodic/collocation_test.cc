#include "coupling/periodic/collocation/collocation.h"
#include "coupling/periodic/collocation/collocation_method.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/coupled_system.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const MatrixXd one = MatrixXd::Identity(1, 1);

} // namespace

/// Every motion of the table, unstable ones too, from a start nearby.
TEST(Collocation, MeetsTheMotionsOfDuffingsOscillator)
{
  CubicSystem           system  = duffing_system(duffing_cases.at("duffing1"));
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.4);
  PeriodicOptions       options;
  options.own["lead-in"] = 0;
  int rows               = 0;
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
    if (row["case"] == "duffing1")
    {
      const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
      const auto     found = collocation_method().solve(problem, {1.001 * q, 0.999 * v, 0.}, options);
      EXPECT_NEAR(found.at(0).q[0], q[0], 1e-9) << row["solution"];
      EXPECT_NEAR(found.at(0).v[0], v[0], 1e-9) << row["solution"];
      ++rows;
    }
  EXPECT_EQ(rows, 3);
}

/// On one mesh after the other, of half the intervals each, the start comes nearer by 2^8.
TEST(Collocation, HasTheOrderOfItsGaussPointsTwice)
{
  CubicSystem           system  = duffing_system(duffing_cases.at("duffing3"));
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 0.45);
  PeriodicOptions       options;
  options.tolerance = 1e-14;
  VectorXd starts(4);
  for (int k = 0; k < 4; ++k)
  {
    PeriodicCollocation collocation(problem);
    const int           n = k == 3 ? 160 : 10 << k;
    std::vector<double> mesh;
    for (int i = 0; i <= n; ++i)
      mesh.push_back(double(i) / n);
    collocation.set_mesh(mesh);
    VectorXd P = VectorXd::Zero(collocation.n_unknowns()), q, v;
    collocation.solve(P, options);
    collocation.state_at_begin(P, q, v);
    starts[k] = q[0];
  }
  const double first = std::abs(starts[1] - starts[3]), second = std::abs(starts[2] - starts[3]);
  EXPECT_GT(std::log2(first / second), 7.);
}

/// Every motion of the table of play, in which nothing of the base holds the mass: its two states are unknowns.  The
/// kinks lie inside intervals, whose halves end the search at 2^-12 of them: their error is the width of a kink's
/// interval, squared.
TEST(Collocation, MeetsTheTableOfPlay)
{
  int rows = 0;
  for (const ReferenceRow &row : read_reference("periodic/clearance_periodic.csv"))
  {
    const ClearanceCase &given   = clearance_cases.at(row["case"]);
    SmallSystem          system  = clearance_system(given);
    const int            ratio   = int(row.number("period_in_forcing_periods"));
    PeriodicProblem      problem = problem_of_period(system, ratio * 2. * M_PI / given.Omega);
    problem.ratio                = ratio;
    const VectorXd  q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
    PeriodicOptions options;
    options.own["lead-in"] = 0;
    const auto found       = collocation_method().solve(problem, {q, v, 0.}, options);
    EXPECT_NEAR(found.at(0).q[0], q[0], 1e-8) << row["case"] << row["solution"];
    EXPECT_NEAR(found.at(0).v[0], v[0], 1e-8) << row["case"] << row["solution"];
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

/// x'' + x = (1 - x^2) x':  period of the limit cycle to all digits (Andersen and Geer 1982).
TEST(Collocation, FindsTheLimitCycleOfVanDerPol)
{
  SmallSystem     system  = van_der_pol(1.);
  PeriodicProblem problem = problem_of_period(system, 6.5);
  problem.phase           = 0;
  const auto found = collocation_method().solve(problem, {VectorXd::Zero(1), VectorXd::Constant(1, 2.), 6.5}, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].period, 6.66328685932313, 1e-9);
  EXPECT_NEAR(found[0].q[0], 0., 1e-10);
  EXPECT_LT(found[0].residual, 1e-8);
  EXPECT_TRUE(found[0].trivial_multiplier);
  EXPECT_TRUE(found[0].stable());
}

/// T -> 2 pi (1 + eps^2/16) where the base itself repeats after 2 pi and only the small force chooses the amplitude.
TEST(Collocation, FindsALimitCycleOfNearlyThePeriodOfTheBase)
{
  constexpr double eps     = 0.01;
  SmallSystem      system  = van_der_pol(eps);
  PeriodicProblem  problem = problem_of_period(system, 6.3);
  problem.phase            = 0;
  PeriodicOptions options;
  options.own["lead-in"] = 0;
  const auto found = collocation_method().solve(problem, {VectorXd::Zero(1), VectorXd::Constant(1, 2.2), 6.3}, options);
  EXPECT_NEAR(found.at(0).period, 2. * M_PI * (1. + eps * eps / 16.), 1e-8);
  EXPECT_NEAR(found.at(0).v[0], 2., 1e-4);
}

/// phi'' J = M_0 - c phi' - k sin(phi): shooting and collocation find the same speed, with a phase off zero.
TEST(Collocation, FindsTheSpeedOfARotorThatNothingHolds)
{
  for (const double bearing : {0.3, 0.})
  {
    SmallSystem system(2. * one, bearing * one, 0. * one);
    system.set_law(VectorXd::Ones(1),
                   [](double u, double v, double &p, double &dp_du, double &dp_dv)
                   {
                     p     = 9. - 1.2 * v - 4. * std::sin(u);
                     dp_du = -4. * std::cos(u);
                     dp_dv = -1.2;
                   });
    PeriodicProblem problem = problem_of_period(system, 1.);
    problem.begin           = 0.7;
    problem.turn            = VectorXd::Constant(1, 2. * M_PI);
    problem.phase           = 0;
    problem.phase_value     = 0.2;
    const PeriodicGuess guess{VectorXd::Constant(1, 0.2), VectorXd::Constant(1, 6.), 1.};
    PeriodicOptions     options;
    options.own["lead-in"] = 0;
    const auto found       = collocation_method().solve(problem, guess, options).at(0);
    const auto by_shot     = shooting_method().solve(problem, guess, options).at(0);
    EXPECT_NEAR(found.period, by_shot.period, 1e-9 * by_shot.period);
    EXPECT_NEAR(found.q[0], 0.2, 1e-10);
    EXPECT_NEAR(found.v[0], by_shot.v[0], 1e-8);
  }
}

/// dr/dy against central quotients, dr/dT too, of a law of two measures with u', in a base with a damped free motion,
/// an undamped one and a spring, on a mesh of unlike intervals.
TEST(Collocation, LinearisesExactly)
{
  CoupledSystem   system(0., 0.3);
  PeriodicProblem problem = problem_of_period(system, 3.);
  problem.turn[1]         = 2. * M_PI;
  problem.phase           = 1;
  problem.phase_value     = 0.1;
  PeriodicCollocation collocation(problem);
  collocation.set_mesh({0., 0.2, 0.5, 1.});

  std::mt19937                     random(7);
  std::uniform_real_distribution<> number(-1., 1.);
  VectorXd y   = VectorXd::NullaryExpr(collocation.n_unknowns(), [&] { return number(random); }), r, above, below;
  y.tail(1)[0] = 3.2;
  Eigen::MatrixXd J, other;
  collocation.linearise(y, r, J);
  const double e = 1e-5;
  for (Eigen::Index k = 0; k < y.size(); ++k)
  {
    VectorXd moved = y;
    moved[k] += e;
    collocation.linearise(moved, above, other);
    moved[k] -= 2. * e;
    collocation.linearise(moved, below, other);
    EXPECT_LT((J.col(k) + (above - below) / (2. * e)).norm(), 1e-7 * (1. + J.col(k).norm())) << k;
  }
}
