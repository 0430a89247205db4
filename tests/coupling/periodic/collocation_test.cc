#include "coupling/periodic/collocation.h"
#include "coupling/periodic/collocation_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"

#include <gtest/gtest.h>

namespace
{

using namespace gestell::coupling;
using namespace gestell::tests;
using Eigen::VectorXd;

} // namespace

/// Every motion of the table, unstable ones too, from a start nearby.
TEST(Collocation, MeetsTheMotionsOfDuffingsOscillator)
{
  CubicSystem           system  = duffing_system(duffing_cases.at("duffing1"));
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.4);
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
    options.lead_in  = 0;
    const auto found = collocation_method().solve(problem, {q, v, 0.}, options);
    EXPECT_NEAR(found.at(0).q[0], q[0], 1e-8) << row["case"] << row["solution"];
    EXPECT_NEAR(found.at(0).v[0], v[0], 1e-8) << row["case"] << row["solution"];
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}
