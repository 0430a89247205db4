// Branches of x'' + 0.2 x' + x^3 = B cos t: what must hold where they turn, double and begin.

#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/periodic/continuation.h"
#include "coupling/periodic/followed_equations.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "coupling/periodic/trace_orbit.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

FamilyMember cubic_oscillator(double B)
{
  const MatrixXd one    = MatrixXd::Identity(1, 1);
  auto           system = std::make_shared<SmallSystem>(one, 0.2 * one, 0. * one);
  system->set_law(VectorXd::Ones(1), law_of([](double u) { return -u * u * u; }, [](double u) { return -3. * u * u; }));
  system->loads().add_harmonic(0, 1., B, 0.);
  return {problem_of_period(*system, 2. * M_PI), system};
}

/// x'' + x' = x (lambda - x - x^2) at rest, beside a linear oscillator that moves.
FamilyMember buckling_oscillator(double lambda)
{
  const MatrixXd one    = MatrixXd::Identity(2, 2);
  auto           system = std::make_shared<SmallSystem>(one, one, one);
  system->set_law(VectorXd::Unit(2, 0), law_of([lambda](double u) { return u * (1. + lambda - u - u * u); },
                                               [lambda](double u) { return 1. + lambda - 2. * u - 3. * u * u; }));
  system->loads().add_harmonic(1, 1., 1., 0.);
  return {problem_of_period(*system, 2. * M_PI), system};
}

/// From a motion to which the oscillator settles from `x` at rest.
Branch branch_from(double x, double from, double to, ContinuationOptions &options)
{
  const FamilyMember first = cubic_oscillator(from);
  PeriodicOptions    settled;
  settled.own["lead-in"] = 200;
  const auto solution =
      shooting_method().solve(first.problem, {VectorXd::Constant(1, x), VectorXd::Zero(1), 0.}, settled);
  options.from         = from;
  options.to           = to;
  const auto equations = shooting_branch(cubic_oscillator, {}, 1.);
  return follow_branch(*equations, solution.at(0), options);
}

const SpecialMotion *found(const Branch &branch, const std::string &kind)
{
  const auto special = std::find_if(branch.special.begin(), branch.special.end(),
                                    [&](const SpecialMotion &motion) { return motion.kind == kind; });
  return special == branch.special.end() ? nullptr : &*special;
}

/// The special motion lies before or behind the point that is called the nearest one.
void expect_beside(const Branch &branch, const SpecialMotion &special)
{
  ASSERT_LT(std::size_t(special.nearest), branch.points.size());
  const auto between = [&](int a, int b)
  {
    const auto   at = [&](int i) { return branch.points[std::size_t(i)].solution.q[0]; };
    const double x  = special.solution.q[0];
    return std::min(at(a), at(b)) <= x && x <= std::max(at(a), at(b));
  };
  const int k = special.nearest;
  EXPECT_TRUE((k > 0 && between(k - 1, k)) || (k + 1 < int(branch.points.size()) && between(k, k + 1)));
}

double nearest_multiplier(const PeriodicSolution &solution, double mu)
{
  return (solution.multipliers.array() - mu).abs().minCoeff();
}

} // namespace

/// At a doubling a multiplier is -1; the motion that leaves there repeats after two periods and not after one.
TEST(Branch, DoublesWhereAMultiplierIsMinusOne)
{
  ContinuationOptions options;
  options.points               = 20;
  const Branch         branch  = branch_from(1.5, 5.1, 5.6, options);
  const SpecialMotion *special = found(branch, "period doubling");
  ASSERT_NE(special, nullptr) << branch.ended;
  // d mu / dB is of order one, the place is known to 1e-9 of the range.
  EXPECT_LT(nearest_multiplier(special->solution, -1.), 1e-6);
  expect_beside(branch, *special);

  SpecialMotion doubled = *special;
  doubled.solution.period *= 2.;
  const auto   equations = shooting_branch(cubic_oscillator, {}, 0.5, 2);
  const Branch other     = follow_new_branch(*equations, doubled, options);
  ASSERT_GT(other.points.size(), 3u) << other.ended;
  const BranchPoint &point = other.points[3];
  EXPECT_EQ(point.solution.ratio, 2);
  FamilyMember member = cubic_oscillator(point.parameter);
  member.problem.period *= 2.;
  std::vector<double> x;
  trace(member.problem, point.solution, 2, [&](const OrbitPoint &at) { x.push_back(at.q[0]); });
  EXPECT_NEAR(x[2], x[0], 1e-6);
  EXPECT_GT(std::abs(x[1] - x[0]), 1e-3);
}

/// Where a symmetric motion becomes lopsided, a multiplier is 1, and the symmetric branch does not turn.
TEST(Branch, LeavesWhereTheSymmetricMotionBecomesUnstable)
{
  ContinuationOptions options;
  options.points               = 20;
  const Branch         branch  = branch_from(0.1, 2.2, 2.8, options);
  const SpecialMotion *special = found(branch, "branch");
  ASSERT_NE(special, nullptr) << branch.ended;
  EXPECT_LT(nearest_multiplier(special->solution, 1.), 1e-6);
  EXPECT_TRUE(branch.points.front().solution.stable());
  EXPECT_FALSE(branch.points.back().solution.stable());
}

/// The lopsided motions of a symmetric oscillator are mirror images of each other: one of them is followed.
TEST(Branch, IsFollowedOnceWhereItsSidesAreMirrorImages)
{
  ContinuationOptions options;
  options.points               = 20;
  const Branch         branch  = branch_from(0.1, 2.2, 2.8, options);
  const SpecialMotion *special = found(branch, "branch");
  ASSERT_NE(special, nullptr) << branch.ended;
  const auto equations = shooting_branch(cubic_oscillator, {}, 1.);
  const auto sides     = follow_new_branches(*equations, *special, options);
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_GT(sides[0].points.size(), 3u);
}

/// x (1 + x) = lambda leaves x = 0 at lambda = 0 to both sides, which are unlike.
TEST(Branch, IsFollowedToBothSidesWhereTheyAreUnlike)
{
  ContinuationOptions  options = branch_options(-0.2, 0.2, 20);
  const FamilyMember   first   = buckling_oscillator(options.from);
  const auto           rest    = shooting_method().solve(first.problem, {VectorXd::Zero(2), VectorXd::Zero(2), 0.}, {});
  const auto           equations = shooting_branch(buckling_oscillator, {}, 1.);
  const Branch         straight  = follow_branch(*equations, rest.at(0), options);
  const SpecialMotion *special   = found(straight, "branch");
  ASSERT_NE(special, nullptr) << straight.ended;
  EXPECT_NEAR(special->parameter, 0., 1e-8);
  const auto sides = follow_new_branches(*equations, *special, options);
  ASSERT_EQ(sides.size(), 2u);
  int above = 0, below = 0;
  for (const Branch &side : sides)
    for (const BranchPoint &point : side.points)
    {
      const double x = point.solution.q[0];
      // x goes by about x (lambda - x - x^2) in a period, which closes to 1e-9
      EXPECT_NEAR(x * (1. + x), point.parameter, 1e-9 / std::abs(x));
      ++(x > 0. ? above : below);
    }
  EXPECT_GT(above, 3);
  EXPECT_GT(below, 3);
}

/// Only the load of the family changes: the modes of its base are found once.
TEST(Branch, FindsTheModesOfTheBaseOnce)
{
  PeriodicOptions settled, shared;
  settled.own["lead-in"]   = 200;
  shared.integration.modes = std::make_shared<SharedModes>();
  const FamilyMember first = cubic_oscillator(2.2);
  const auto         solution =
      shooting_method().solve(first.problem, {VectorXd::Constant(1, 0.1), VectorXd::Zero(1), 0.}, settled);
  ContinuationOptions options   = branch_options(2.2, 2.4, 5);
  const auto          equations = shooting_branch(cubic_oscillator, shared, 1.);
  EXPECT_GT(follow_branch(*equations, solution.at(0), options).points.size(), 3u);
  EXPECT_EQ(shared.integration.modes->found(), 1);
}

TEST(Branch, KeepsWhatItHasWhenItIsInterrupted)
{
  const std::atomic<bool> stop    = true;
  int                     members = 0;
  const auto              family  = [&](double B)
  {
    FamilyMember member = cubic_oscillator(B);
    if (++members > 40)
      member.problem.stop = &stop;
    return member;
  };
  const FamilyMember  first    = cubic_oscillator(1.);
  const auto          solution = shooting_method().solve(first.problem, {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, {});
  const auto          equations = shooting_branch(family, {}, 1.);
  ContinuationOptions options;
  options.from        = 1.;
  options.to          = 2.;
  const Branch branch = follow_branch(*equations, solution.at(0), options);
  EXPECT_GT(branch.points.size(), 2u);
  EXPECT_TRUE(branch.failed);
  EXPECT_EQ(branch.ended, "interrupted");
}
