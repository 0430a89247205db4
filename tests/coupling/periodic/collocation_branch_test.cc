// Branches by collocation against the same by shooting.

#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/periodic/collocation/collocation_branch.h"
#include "coupling/periodic/continuation.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/play_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::VectorXd;

template <class System, class From>
FamilyMember member_of(const From &made, double period, int phase = -1)
{
  auto         system = std::make_shared<System>(made);
  FamilyMember member{problem_of_period(*system, period), system};
  member.problem.phase = phase;
  return member;
}

struct TwoBranches
{
  Branch by_shooting, by_collocation;
};

/// From a motion to which the first member settles.
TwoBranches follow(const ProblemFamily &family, const PeriodicGuess &guess, const ContinuationOptions &options)
{
  const FamilyMember first = family(options.from);
  PeriodicOptions    settled;
  settled.own["lead-in"] = 100;
  const auto solution    = shooting_method().solve(first.problem, guess, settled).at(0);
  const auto shooting    = shooting_branch(family, {}, 2. * M_PI / solution.period),
             collocation = collocation_branch(family, {});
  return {follow_branch(*shooting, solution, options), follow_branch(*collocation, solution, options)};
}

void expect_same_ends(const TwoBranches &branches, double tolerance)
{
  ASSERT_FALSE(branches.by_collocation.points.empty());
  EXPECT_FALSE(branches.by_collocation.failed) << branches.by_collocation.ended;
  EXPECT_EQ(branches.by_collocation.ended, branches.by_shooting.ended);
  const BranchPoint &a = branches.by_shooting.points.back(), &b = branches.by_collocation.points.back();
  EXPECT_EQ(b.solution.method, "collocation");
  EXPECT_NEAR(b.parameter, a.parameter, tolerance);
  EXPECT_NEAR(b.solution.period, a.solution.period, tolerance * a.solution.period);
  EXPECT_LT((b.solution.q - a.solution.q).norm() + (b.solution.v - a.solution.v).norm(), tolerance);
  EXPECT_LT((b.solution.multipliers - a.solution.multipliers).norm(), 100. * tolerance);
  ASSERT_EQ(branches.by_collocation.special.size(), branches.by_shooting.special.size());
  for (std::size_t i = 0; i < branches.by_shooting.special.size(); ++i)
  {
    EXPECT_EQ(branches.by_collocation.special[i].kind, branches.by_shooting.special[i].kind);
    EXPECT_NEAR(branches.by_collocation.special[i].parameter, branches.by_shooting.special[i].parameter, tolerance);
  }
}

} // namespace

TEST(CollocationBranch, GoesRoundTheFoldsOfDuffingsOscillator)
{
  ContinuationOptions options  = branch_options(1., 2., 12);
  const auto          branches = follow(
      [](double Omega)
      {
        DuffingCase given = duffing_cases.at("duffing1");
        given.Omega       = Omega;
        return member_of<CubicSystem>(duffing_system(given), 2. * M_PI / Omega);
      },
      {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
  expect_same_ends(branches, 1e-7);
  EXPECT_EQ(branches.by_collocation.special.size(), 2u);
}

/// Events move along the branch, and the mesh with them; where they begin it grazes.
TEST(CollocationBranch, FollowsTheEventsOfPlay)
{
  ContinuationOptions options  = branch_options(1., 0.2, 8);
  const auto          branches = follow(
      [](double F)
      {
        ClearanceCase given = clearance_cases.at("clearance1");
        given.F             = F;
        return member_of<PlaySystem>(clearance_system(given), 2. * M_PI / given.Omega);
      },
      {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
  expect_same_ends(branches, 1e-7);
}

/// The amplitude of the load rises from zero: a branch that begins at rest has no size at first.
TEST(CollocationBranch, BeginsAtRest)
{
  ContinuationOptions options  = branch_options(0., 0.3, 6);
  const auto          branches = follow(
      [](double F)
      {
        DuffingCase given = duffing_cases.at("duffing1");
        given.F           = F;
        return member_of<CubicSystem>(duffing_system(given), 2. * M_PI / given.Omega);
      },
      {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
  expect_same_ends(branches, 1e-7);
  EXPECT_GT(branches.by_collocation.points.size(), 5u);
}

/// The period changes along the branch and is an unknown of it.
TEST(CollocationBranch, FollowsALimitCycle)
{
  ContinuationOptions options  = branch_options(0.5, 3., 10);
  const auto          branches = follow([](double eps) { return member_of<SmallSystem>(van_der_pol(eps), 6.5, 0); },
                               {VectorXd::Zero(1), VectorXd::Constant(1, 2.), 6.5}, options);
  expect_same_ends(branches, 1e-7);
  EXPECT_NEAR(branches.by_collocation.points.back().solution.period, 8.85909550, 1e-6); // Andersen and Geer 1982
}

/// The motion of two periods that leaves at a doubling.
TEST(CollocationBranch, LeavesAtAPeriodDoubling)
{
  const ProblemFamily family = [](double B)
  {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
    CubicSystem           system(one, 0.2 * one, 0. * one, {{1., VectorXd::Ones(1)}});
    system.loads().add_harmonic(0, 1., B, 0.);
    return member_of<CubicSystem>(system, 2. * M_PI);
  };
  ContinuationOptions options  = branch_options(5.1, 5.6, 4);
  const auto          branches = follow(family, {VectorXd::Constant(1, 1.5), VectorXd::Zero(1), 0.}, options);
  expect_same_ends(branches, 1e-6);
  ASSERT_FALSE(branches.by_collocation.special.empty());
  SpecialMotion doubled = branches.by_collocation.special[0];
  EXPECT_EQ(doubled.kind, "period doubling");
  doubled.solution.period *= 2.;
  options.points     = 20;
  options.most       = 4;
  const Branch other = follow_new_branch(*collocation_branch(family, {}, 2), doubled, options);
  ASSERT_GT(other.points.size(), 3u) << other.ended;
  EXPECT_EQ(other.points[3].solution.ratio, 2);
  EXPECT_LT(other.points[3].solution.residual, 1e-7);
}

} // namespace gestell::tests
