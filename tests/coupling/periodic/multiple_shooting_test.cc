#include "coupling/periodic/shooting/multiple_shooting.h"

#include "coupling/periodic/collocation/collocation_method.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/shooting/shooting.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "coupling/periodic/trace_orbit.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const MatrixXd one = MatrixXd::Identity(1, 1);

PeriodicOptions in_segments(int segments)
{
  PeriodicOptions options;
  options.own["lead-in"] = 0;
  options.segments       = segments;
  options.tolerance      = 1e-12;
  return options;
}

/// What yields keeps the largest way it has seen.
class Yielding final : public SmallSystem
{
public:
  Yielding() : SmallSystem(one, 0.2 * one, one)
  {
    set_law(VectorXd::Ones(1), law_of([](double) { return 0.; }, [](double) { return 0.; }));
    loads().add_harmonic(0, 1.5, 1., 0.);
  }
  Vector save_history() const override { return Vector::Constant(1, reached); }
  void   restore_history(const Vector &saved) override { reached = saved[0]; }
  void   start(const LocalState &state) override { reached = state.u[0]; }
  void   accept(const LocalState &state) override { reached = std::max(reached, state.u[0]); }

private:
  double reached = 0.;
};

/// x'' + 2 zeta x' - x + x^3 = F cos(Omega t), about the hilltop x = 0 of its two valleys.
SmallSystem hilltop(double zeta, double F, double Omega)
{
  SmallSystem system(one, 2. * zeta * one, 0. * one);
  system.set_law(VectorXd::Ones(1),
                 law_of([](double u) { return u - u * u * u; }, [](double u) { return 1. - 3. * u * u; }));
  system.loads().add_harmonic(0, Omega, F, 0.);
  return system;
}

} // namespace

/// Against the whole matrix at once, with and without the unknown period.
TEST(CyclicSystem, IsSolvedAsTheWholeMatrixIs)
{
  for (const Index extra : {0, 1})
    for (const int M : {1, 2, 5})
    {
      const Index           N = 4, size = N * M + extra;
      std::vector<MatrixXd> A;
      const MatrixXd        b     = MatrixXd::Random(N, extra * M);
      MatrixXd              whole = MatrixXd::Zero(size, size);
      for (int i = 0; i < M; ++i)
      {
        A.push_back(10. * MatrixXd::Random(N, N));
        whole.block(i * N, i * N, N, N) += A.back();
        whole.block(i * N, (i + 1) % M * N, N, N) -= MatrixXd::Identity(N, N);
        if (extra)
          whole.col(N * M).segment(i * N, N) = b.col(i);
      }
      if (extra)
        whole(N * M, 2) = 1.;
      const VectorXd r = VectorXd::Random(size), x = CyclicSystem(A, b, 2).solve(r);
      EXPECT_LT((whole * x - r).norm(), 1e-11 * whole.norm() * x.norm()) << M << " blocks";
    }
}

/// Where the product of the blocks is 1e40 it has forgotten the way that shrinks, the cyclic system has not.
TEST(CyclicSystem, KeepsTheDigitsThatTheProductOfItsBlocksLoses)
{
  constexpr int         M = 20;
  std::vector<MatrixXd> A;
  VectorXd              x(2 * M), r(2 * M);
  for (int i = 0; i < M; ++i)
  {
    const Eigen::Rotation2Dd turn(0.3 * i);
    A.push_back(turn.toRotationMatrix() * Eigen::Vector2d(100., 0.01).asDiagonal());
    x.segment(2 * i, 2) << std::cos(i), std::sin(2. * i);
  }
  for (int i = 0; i < M; ++i)
    r.segment(2 * i, 2) = A[std::size_t(i)] * x.segment(2 * i, 2) - x.segment(2 * ((i + 1) % M), 2);
  EXPECT_LT((CyclicSystem(A, MatrixXd(2, 0), -1).solve(r) - x).norm(), 1e-12 * x.norm());
}

/// What is balanced on a hilltop parts by 10^7 and 10^17 in a period.  From a start off by some percent one
/// passage leaves the hill; segments stay, and find the motion that harmonic balance finds, which follows nothing.
TEST(MultipleShooting, ClosesAMotionTooUnstableToBeFollowedForAPeriod)
{
  constexpr double zeta = 0.05, F = 0.1;
  for (const auto &[Omega, parts] : {std::pair(0.36, 1e7), std::pair(0.15, 1e17)})
  {
    SmallSystem           system  = hilltop(zeta, F, Omega);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / Omega);
    const PeriodicGuess   guess   = {VectorXd::Constant(1, -1.05 * F / (1. + Omega * Omega)), VectorXd::Zero(1), 0.};
    PeriodicOptions       options;
    options.own["lead-in"] = 0;
    ShootingEquations once(problem, options.integration);
    EXPECT_THROW(shoot(once, problem, once.unknowns(guess.q, guess.v, problem.period), options), NoPeriodicMotion);

    const auto found    = shooting_method().solve(problem, guess, options).at(0);
    const auto balanced = harmonic_balance_method().solve(problem, guess, options).at(0);
    EXPECT_LT(found.residual, 1e-10);
    EXPECT_NEAR(found.q[0], balanced.q[0], 1e-9);
    EXPECT_NEAR(found.v[0], balanced.v[0], 1e-9);
    EXPECT_FALSE(found.stable());
    EXPECT_GT(found.largest_multiplier(), parts);
    EXPECT_THAT(found.notes, testing::Contains(testing::HasSubstr("solved by multiple shooting in")));

    options.segments      = 48;
    const auto in_smaller = shooting_method().solve(problem, guess, options).at(0);
    EXPECT_NEAR(in_smaller.largest_multiplier() / found.largest_multiplier(), 1., 1e-9);
  }
}

TEST(MultipleShooting, RefusesElementsThatRememberMoreThanTheirBranch)
{
  Yielding              system;
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.5);
  try
  {
    shooting_method().solve(problem, {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, in_segments(8));
    FAIL() << "closes";
  }
  catch (const NoPeriodicMotion &reason)
  {
    EXPECT_THAT(reason.what(), testing::HasSubstr("elements have hysteresis"));
  }
}

/// Rest repeats after any time: from starts of a wrong period no method gives it for the limit cycle.
TEST(UnknownPeriod, IsNotThatOfRest)
{
  for (const auto &[eps, v, T] : {std::tuple(1., 0.3, 1.), std::tuple(5., 2., 3.), std::tuple(5., 0.3, 15.)})
  {
    SmallSystem     system  = van_der_pol(eps);
    PeriodicProblem problem = problem_of_period(system, T);
    problem.phase           = 0;
    PeriodicOptions options;
    options.own["lead-in"] = 0;
    for (const PeriodicMethod *method : {&shooting_method(), &collocation_method()})
      try
      {
        const auto found = method->solve(problem, {VectorXd::Zero(1), VectorXd::Constant(1, v), T}, options).at(0);
        EXPECT_GT(std::abs(found.v[0]), 0.1) << method->name() << " eps " << eps << " v " << v << " T " << T;
      }
      catch (const NoPeriodicMotion &)
      {
      }
  }
}

/// Signals of a motion that one passage does not close are those of its segments, which stay on the hilltop.
TEST(MultipleShooting, IsTracedFromSegmentToSegment)
{
  constexpr double      Omega   = 0.15;
  SmallSystem           system  = hilltop(0.05, 0.1, Omega);
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / Omega);
  PeriodicOptions       options;
  options.own["lead-in"] = 0;
  const auto found =
      shooting_method().solve(problem, {VectorXd::Constant(1, -0.1), VectorXd::Zero(1), 0.}, options).at(0);
  int    points  = 0;
  double largest = 0., last = 0.;
  trace(problem, found, 100,
        [&](const OrbitPoint &point)
        {
          EXPECT_NEAR(point.t, found.begin + found.period * points / 100., 1e-9);
          largest = std::max(largest, std::abs(point.q[0]));
          last    = point.q[0];
          ++points;
        });
  EXPECT_EQ(points, 101);
  EXPECT_LT(largest, 0.11);
  EXPECT_NEAR(last, found.q[0], 1e-8);
}

} // namespace gestell::tests
