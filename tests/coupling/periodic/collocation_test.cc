#include "coupling/periodic/collocation.h"
#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"

#include <gtest/gtest.h>

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x'' + 2 zeta x' + x = F cos(Omega t) + p(x)
SmallSystem oscillator(double zeta, double F, double Omega, const SmallSystem::Law &law)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(one, 2. * zeta * one, one);
  system.set_law(VectorXd::Ones(1), law);
  system.loads().add_harmonic(0, Omega, F, 0.);
  return system;
}

PeriodicProblem problem_of(SmallSystem &system, double Omega)
{
  PeriodicProblem problem;
  problem.system = &system;
  problem.period = 2. * M_PI / Omega;
  problem.turn   = VectorXd::Zero(1);
  return problem;
}

SmallSystem::Law cubic(double beta)
{
  return [beta](double u, double, double &p, double &dp_du, double &dp_dv)
  {
    p     = -beta * u * u * u;
    dp_du = -3. * beta * u * u;
    dp_dv = 0.;
  };
}

} // namespace

/// Every motion of the table, unstable ones too, from a start nearby.
TEST(Collocation, MeetsTheMotionsOfDuffingsOscillator)
{
  SmallSystem           system  = oscillator(0.05, 0.3, 1.4, cubic(0.5));
  const PeriodicProblem problem = problem_of(system, 1.4);
  PeriodicOptions       options;
  options.lead_in = 0;
  int rows        = 0;
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
  SmallSystem           system  = oscillator(0.05, 0.8, 0.45, cubic(1.));
  const PeriodicProblem problem = problem_of(system, 0.45);
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
