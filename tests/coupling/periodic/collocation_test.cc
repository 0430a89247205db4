#include "coupling/periodic/collocation/collocation.h"
#include "coupling/periodic/collocation/collocation_method.h"
#include "tests/support/coupled_system.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/test.h"

#include <random>

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

} // namespace

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
