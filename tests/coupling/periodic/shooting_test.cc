#include "coupling/periodic/minimising.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"

#include <gtest/gtest.h>

#include <map>

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x'' + 2 zeta x' + x + beta x^3 = F cos(Omega t), a case of the reference.
struct DuffingCase
{
  double zeta, beta, F, Omega;
};
const std::map<std::string, DuffingCase> cases = {{"duffing1", {0.05, 0.5, 0.3, 1.4}},
                                                  {"duffing2", {0.02, -0.05, 0.1, 0.9}},
                                                  {"duffing3", {0.05, 1.0, 0.8, 0.45}},
                                                  {"duffing4", {0.005, 0.02, 0.03, 1.03}}};

SmallSystem duffing(const DuffingCase &given)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(one, 2. * given.zeta * one, one);
  system.set_law(VectorXd::Ones(1),
                 [beta = given.beta](double u, double, double &p, double &dp_du, double &dp_dv)
                 {
                   p     = -beta * u * u * u;
                   dp_du = -3. * beta * u * u;
                   dp_dv = 0.;
                 });
  system.loads().add_harmonic(0, given.Omega, given.F, 0.);
  return system;
}

PeriodicProblem problem_of(SmallSystem &system, double Omega)
{
  PeriodicProblem problem;
  problem.system = &system;
  problem.period = 2. * M_PI / Omega;
  problem.turn   = VectorXd::Zero(system.size());
  return problem;
}

class DuffingTable : public testing::TestWithParam<std::string>
{
};

} // namespace

/// Every solution of the table, unstable ones too, from a start nearby: the start is the unknown, so it is met as well
/// as the motion closes; multipliers are those of the reference.
TEST_P(DuffingTable, IsMetByShooting)
{
  SmallSystem     system  = duffing(cases.at(GetParam()));
  PeriodicProblem problem = problem_of(system, cases.at(GetParam()).Omega);
  PeriodicOptions options;
  options.own["lead-in"] = 0;
  options.tolerance      = 1e-12;
  int rows               = 0;
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
    if (row["case"] == GetParam())
    {
      ++rows;
      const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
      const auto     found = shooting_method().solve(problem, {1.001 * q, 0.999 * v, 0.}, options);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].q[0], q[0], 1e-10);
      EXPECT_NEAR(found[0].v[0], v[0], 1e-10);
      const std::complex<double> mu(row.number("mu1_re"), row.number("mu1_im"));
      EXPECT_LT((found[0].multipliers.array() - mu).abs().minCoeff(), 1e-8);
      EXPECT_EQ(found[0].stable(), row["stability"] == "stable");
    }
  EXPECT_GT(rows, 0);
}

/// All solutions, from no more than the machine at rest.
TEST_P(DuffingTable, IsFoundWithoutBeingTold)
{
  SmallSystem     system  = duffing(cases.at(GetParam()));
  PeriodicProblem problem = problem_of(system, cases.at(GetParam()).Omega);
  PeriodicOptions options;
  options.own["starts"] = 24;
  const auto found      = minimising_method().solve(problem, {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
    if (row["case"] == GetParam())
    {
      double nearest = 1.;
      for (const PeriodicSolution &solution : found)
        if (solution.ratio == 1)
          nearest =
              std::min(nearest, std::hypot(solution.q[0] - row.number("x(0)"), solution.v[0] - row.number("v(0)")));
      EXPECT_LT(nearest, 1e-8) << "solution " << row["solution"];
    }
}

INSTANTIATE_TEST_SUITE_P(Reference, DuffingTable, testing::Values("duffing1", "duffing2", "duffing3", "duffing4"),
                         [](const auto &info) { return info.param; });
