// Harmonic balance of laws with branches, and of those that remember.

#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// p = -(u - u_max/2): what it has reached it keeps.
class Ratchet final : public SmallSystem
{
public:
  Ratchet() : SmallSystem(MatrixXd::Identity(1, 1), 0.1 * MatrixXd::Identity(1, 1), MatrixXd::Identity(1, 1))
  {
    set_law(VectorXd::Ones(1), [this](double u, double, double &p, double &dp_du, double &dp_dv)
            { p = -(u - 0.5 * reached), dp_du = -1., dp_dv = 0.; });
    loads().add_harmonic(0, 0.8, 1., 0.);
  }
  Vector save_history() const override { return Vector::Constant(1, reached); }
  void   restore_history(const Vector &saved) override { reached = saved[0]; }
  void   start(const LocalState &state) override { reached = std::max(0., state.u[0]); }
  void   accept(const LocalState &state) override { reached = std::max(reached, state.u[0]); }

  double reached = 0.;
};

class Sticking final : public SmallSystem
{
public:
  using SmallSystem::SmallSystem;
  const std::vector<HeldMeasure> &held() const override { return held_; }

private:
  std::vector<HeldMeasure> held_ = {{0, 0.}};
};

} // namespace

/// Every motion of the table, subharmonic ones too, as near as the note says; the mean that nothing of the base holds
/// is an unknown.
TEST(HarmonicBalance, MeetsTheTableOfPlayAsWellAsStated)
{
  int rows = 0;
  for (const ReferenceRow &row : read_reference("periodic/clearance_periodic.csv"))
  {
    const ClearanceCase &given   = clearance_cases.at(row["case"]);
    SmallSystem          system  = clearance_system(given);
    const int            ratio   = int(row.number("period_in_forcing_periods"));
    PeriodicProblem      problem = problem_of_period(system, ratio * 2. * M_PI / given.Omega);
    problem.ratio                = ratio;
    const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
    const auto     found = harmonic_balance_method().solve(problem, {q, v, 0.}, {});
    ASSERT_EQ(found.size(), 1u);
    HarmonicBalance balance(problem, found[0].series->harmonics());
    const VectorXd  z        = balance.pack(*found[0].series);
    const double    reported = balance.left_out(z).motion * balance.scales(z)[0];
    // the motion answers to what is left out of its forces with 1/(1 - mu) at most, mu up to 0.85 here
    EXPECT_LT(std::abs(found[0].q[0] - q[0]), 10. * reported + 1e-10) << row["case"] << row["solution"];
    EXPECT_LT(std::abs(found[0].q[0] - q[0]), 1e-6) << row["case"] << row["solution"];
    EXPECT_THAT(found[0].notes.at(0),
                testing::HasSubstr(reported > 1e-9 ? "as kinks of a force law do" : "of the motion"));
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

TEST(HarmonicBalance, RefusesLawsThatRemember)
{
  Ratchet         system;
  PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 0.8);
  system.reached          = 0.25;
  expect_refusal([&] { harmonic_balance_method().solve(problem, {}, {}); }, "has hysteresis");
  EXPECT_EQ(system.reached, 0.25) << "what the system remembers is given back";
}

TEST(HarmonicBalance, RefusesWhatSticks)
{
  Sticking system(MatrixXd::Identity(1, 1), MatrixXd::Identity(1, 1), MatrixXd::Identity(1, 1));
  system.set_law(VectorXd::Ones(1), law_of([](double) { return 0.; }, [](double) { return 0.; }));
  system.loads().add_harmonic(0, 1.5, 1., 0.);
  expect_refusal([&] { harmonic_balance_method().solve(problem_of_period(system, 2. * M_PI / 1.5), {}, {}); },
                 "sticks");
}

} // namespace gestell::tests
