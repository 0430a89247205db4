// To which motion starts settle.

#include "coupling/periodic/basins.h"
#include "coupling/periodic/minimising.h"
#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const PeriodicGuess at_rest{VectorXd::Zero(1), VectorXd::Zero(1), 0.};
const auto          silent = [](double) {};

PeriodicProblem problem_of(CubicSystem &system, const DuffingCase &given)
{
  return problem_of_period(system, 2. * M_PI / given.Omega);
}

std::vector<PeriodicSolution> all_motions(const PeriodicProblem &problem)
{
  PeriodicOptions options;
  options.own["starts"] = 10;
  return minimising_method().solve(problem, at_rest, options);
}

/// State 150 periods later: the transient has fallen to exp(-0.05 * 670) = 3e-15.
VectorXd settled(const PeriodicProblem &problem, double x, double v)
{
  PeriodFlow flow(problem, PeriodicOptions().integration);
  VectorXd   q = VectorXd::Constant(1, x), w = VectorXd::Constant(1, v);
  for (int k = 0; k < 150; ++k)
  {
    flow.pass(q, w, problem.period, false);
    q = flow.passage().q;
    w = flow.passage().v;
  }
  return Eigen::Vector2d(q[0], w[0]);
}

} // namespace

TEST(Basins, OfALinearOscillatorIsThePlane)
{
  const DuffingCase linear{0.1, 0., 0.3, 1.4};
  CubicSystem       system   = duffing_system(linear);
  PeriodicProblem   problem  = problem_of(system, linear);
  const auto        solution = shooting_method().solve(problem, at_rest, {});
  double            last     = 0.;
  const Basins      basins =
      basins_of(problem, solution, at_rest, {0, 1, -5., 5., -5., 5., 6}, {}, [&](double share) { last = share; });
  EXPECT_TRUE((basins.motion.array() == 1).all());
  EXPECT_EQ(basins.share(1), 1.);
  EXPECT_EQ(last, 1.);
  // |x_k| falls by exp(-0.1 T) a period: from 5 + |x| to 0.01 |x| takes ln(...)/(0.1 T) of them, from the middle fewer
  const double size = std::hypot(1.4 * solution[0].q[0], solution[0].v[0]);
  EXPECT_LE(basins.periods.maxCoeff(), 1.5 + std::log((8.6 + size) / (0.01 * size)) / (0.1 * problem.period));
}

/// Nothing drives it: the only motion is rest, to which the size of the plane is the measure.
TEST(Basins, OfRestAreMeasuredByThePlane)
{
  const DuffingCase linear{0.1, 0., 0., 1.4};
  CubicSystem       system   = duffing_system(linear);
  PeriodicProblem   problem  = problem_of(system, linear);
  const auto        solution = shooting_method().solve(problem, at_rest, {});
  const Basins      basins   = basins_of(problem, solution, at_rest, {0, 1, -5., 5., -5., 5., 3}, {}, silent);
  EXPECT_TRUE((basins.motion.array() == 1).all());
  EXPECT_EQ(basins.periods(1, 1), 0);
  EXPECT_GT(basins.periods(0, 0), 5);
}

/// Two stable motions share the plane; each start is found where it settles by itself.
TEST(Basins, OfDuffingsOscillatorAreThoseOfSettlingItself)
{
  const DuffingCase            &given     = duffing_cases.at("duffing1");
  CubicSystem                   system    = duffing_system(given);
  PeriodicProblem               problem   = problem_of(system, given);
  std::vector<PeriodicSolution> solutions = all_motions(problem);
  ASSERT_EQ(solutions.size(), 3u);
  const Basins basins = basins_of(problem, solutions, at_rest, {0, 1, -3., 3., -3., 3., 6}, {}, silent);
  EXPECT_TRUE(basins.is_complete());
  int kinds = 0;
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(basins.share(k + 1) > 0., solutions[std::size_t(k)].stable());
    kinds += basins.share(k + 1) > 0.;
  }
  EXPECT_EQ(kinds, 2);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
    {
      const PeriodicSolution &motion = solutions[std::size_t(basins.motion(i, j)) - 1];
      const VectorXd          end    = settled(problem, basins.plane.x_at(i), basins.plane.y_at(j));
      EXPECT_LT((end - Eigen::Vector2d(motion.q[0], motion.v[0])).norm(), 1e-8) << i << ' ' << j;
    }
}

/// Three starts, a period of the load apart, lead to one motion of three periods.
TEST(Basins, TakeASubharmonicMotionInAnyOfItsPeriods)
{
  const DuffingCase given{0.025, 0.5, 3., 3.3};
  CubicSystem       system = duffing_system(given);
  PeriodicProblem   one = problem_of(system, given), three = one;
  three.period *= 3.;
  three.ratio = 3;
  PeriodicGuess   guess{VectorXd::Zero(1), VectorXd::Constant(1, 4.), 0.};
  PeriodicOptions options;
  options.own["lead-in"] = 100;
  auto solutions         = shooting_method().solve(three, guess, options);
  ASSERT_TRUE(solutions[0].stable());
  PeriodFlow flow(one, options.integration);
  VectorXd   q = solutions[0].q, v = solutions[0].v;
  for (int k = 0; k < 3; ++k)
  {
    const double w = 1e-6;
    const Basins basins =
        basins_of(one, solutions, at_rest, {0, 1, q[0] - w, q[0] + w, v[0] - w, v[0] + w, 1}, {}, silent);
    EXPECT_EQ(basins.motion(0, 0), 1);
    EXPECT_EQ(basins.periods(0, 0), 0);
    flow.pass(q, v, one.period, false);
    q = flow.passage().q;
    v = flow.passage().v;
  }
}

/// x'' + 0.1 x' + x - x^3 = 0.02 cos(0.7 t) leaves its well from beyond |x| = 1.
TEST(Basins, TellStartsThatRunAway)
{
  const DuffingCase soft{0.05, -1., 0.02, 0.7};
  CubicSystem       system    = duffing_system(soft);
  PeriodicProblem   problem   = problem_of(system, soft);
  const auto        solutions = shooting_method().solve(problem, at_rest, {});
  const Basins      basins    = basins_of(problem, solutions, at_rest, {0, 1, -3., 3., -0.1, 0.1, 3}, {}, silent);
  EXPECT_EQ(basins.motion(1, 1), 1);
  EXPECT_EQ(basins.motion(0, 1), Basins::not_reached);
  EXPECT_EQ(basins.motion(2, 1), Basins::not_reached);
}

TEST(Basins, RefuseWhatHasNoneAndKeepWhatAnInterruptionLeaves)
{
  const DuffingCase &given     = duffing_cases.at("duffing1");
  CubicSystem        system    = duffing_system(given);
  PeriodicProblem    problem   = problem_of(system, given);
  auto               solutions = shooting_method().solve(problem, at_rest, {});
  const StartPlane   plane{0, 1, -1., 1., -1., 1., 4};
  std::atomic<bool>  stop = false;
  problem.stop            = &stop;
  const Basins part = basins_of(problem, solutions, at_rest, plane, {}, [&](double share) { stop = share > 0.4; });
  EXPECT_FALSE(part.is_complete());
  EXPECT_NE(part.motion(0, 0), Basins::not_looked_at);
  EXPECT_EQ(part.motion(3, 3), Basins::not_looked_at);
  stop = false;
  expect_refusal([&] { basins_of(problem, solutions, at_rest, {0, 0, -1., 1., -1., 1., 4}, {}, silent); }, "different");
  solutions[0].multipliers.setConstant(2.);
  expect_refusal([&] { basins_of(problem, solutions, at_rest, plane, {}, silent); }, "stable");
  problem.phase = 0;
  expect_refusal([&] { basins_of(problem, solutions, at_rest, plane, {}, silent); }, "period is unknown");
}

} // namespace gestell::tests
