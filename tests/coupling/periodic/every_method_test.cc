// What every way to a periodic motion must find: the motions of the reference tables, limit cycles, speeds.

#include "coupling/periodic/collocation/collocation_method.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/play_system.h"
#include "tests/support/reference_table.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Way
{
  const PeriodicMethod *method;
  int                   segments; ///< of shooting; 0: as many as it chooses
  double                state;    ///< to which a start is met
};

/// Shooting closes to rounding, collocation and harmonic balance to what they leave of a motion.
const Way by_one_segment = {&shooting_method(), 1, 1e-10}, by_five = {&shooting_method(), 5, 1e-10},
          by_sixteen = {&shooting_method(), 16, 1e-10}, by_chosen = {&shooting_method(), 0, 1e-10},
          by_collocation = {&collocation_method(), 0, 1e-8}, by_balance = {&harmonic_balance_method(), 0, 1e-8};

PeriodicSolution solved(const Way &way, const PeriodicProblem &problem, const PeriodicGuess &guess)
{
  PeriodicOptions options;
  options.own["lead-in"] = 0;
  options.segments       = way.segments;
  if (way.method == &shooting_method())
    options.tolerance = 1e-12;
  const auto found = way.method->solve(problem, guess, options);
  EXPECT_EQ(found.size(), 1u);
  return found.at(0);
}

void expect_row(const ReferenceRow &row, const Way &way, const PeriodicProblem &problem)
{
  SCOPED_TRACE(way.method->name() + std::to_string(way.segments) + ": " + row["case"] + ", " + row["solution"]);
  const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
  const std::complex<double> mu(row.number("mu1_re"), row.number("mu1_im"));
  const PeriodicSolution     found = solved(way, problem, {1.001 * q, 0.999 * v, 0.});
  EXPECT_NEAR(found.q[0], q[0], way.state);
  EXPECT_NEAR(found.v[0], v[0], way.state);
  EXPECT_LT((found.multipliers.array() - mu).abs().minCoeff(), 1e-8);
  EXPECT_EQ(found.stable(), row["stability"] == "stable");
}

} // namespace

/// Every motion of the table, unstable ones too, from a start nearby, with its multipliers.
TEST(EveryMethod, MeetsTheTableOfDuffingsOscillator)
{
  int rows = 0;
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
  {
    CubicSystem           system  = duffing_system(duffing_cases.at(row["case"]));
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / duffing_cases.at(row["case"]).Omega);
    for (const Way &way : {by_one_segment, by_five, by_sixteen, by_collocation, by_balance})
      expect_row(row, way, problem);
    ++rows;
  }
  EXPECT_GT(rows, 8);
}

/// Two masses with cubic springs: every motion of the table, its start and multipliers.
TEST(EveryMethod, MeetsTheTableOfTwoMasses)
{
  for (const ReferenceRow &row : read_reference("periodic/two_dof_shooting.csv"))
  {
    CubicSystem           system  = two_dof_system(row["case"], row.number("Omega"));
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / row.number("Omega"));
    const Eigen::Vector2d q(row.number("q1(0)"), row.number("q2(0)")), v(row.number("v1(0)"), row.number("v2(0)"));
    for (const Way &way : {by_chosen, by_balance})
    {
      SCOPED_TRACE(way.method->name() + row["case"] + row["Omega"] + row["solution"]);
      const PeriodicSolution found = solved(way, problem, {q, v, 0.});
      EXPECT_LT((found.q - q).norm() + (found.v - v).norm(), way.state);
      ASSERT_EQ(found.multipliers.size(), 4);
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(std::abs(found.multipliers[k]), row.number("|mu" + std::to_string(k + 1) + "|"), 1e-8);
      EXPECT_EQ(found.stable(), row["stability"] == "stable");
    }
  }
}

/// Nothing of the base holds the mass: its two states are unknowns.  Segments end within branches of the play and
/// within the play; the events between them are those of the table.  Kinks lie inside intervals of collocation, whose
/// halves end the search at 2^-12 of them: their error is the width of a kink's interval, squared.
TEST(EveryMethod, MeetsTheTableOfPlayThroughItsEvents)
{
  int rows = 0;
  for (const ReferenceRow &row : read_reference("periodic/clearance_periodic.csv"))
  {
    const ClearanceCase &given = clearance_cases.at(row["case"]);
    PlaySystem           located(clearance_system(given));
    SmallSystem          smooth = clearance_system(given);
    for (const Way &way : {Way{&shooting_method(), 7, 1e-10}, by_collocation})
    {
      const int       ratio   = int(row.number("period_in_forcing_periods"));
      const bool      is_shot = way.method == &shooting_method();
      PeriodicProblem problem =
          problem_of_period(is_shot ? static_cast<SmallSystem &>(located) : smooth, ratio * 2. * M_PI / given.Omega);
      problem.ratio    = ratio;
      const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
      const auto     found =
          solved(way, problem, is_shot ? PeriodicGuess{1.001 * q, 0.999 * v, 0.} : PeriodicGuess{q, v, 0.});
      EXPECT_NEAR(found.q[0], q[0], way.state) << row["case"] << row["solution"];
      EXPECT_NEAR(found.v[0], v[0], way.state) << row["case"] << row["solution"];
      if (!is_shot)
        continue;
      const std::complex<double> mu(row.number("mu1_re"), row.number("mu1_im"));
      EXPECT_LT((found.multipliers.array() - mu).abs().minCoeff(), 1e-8) << row["case"] << row["solution"];
      EXPECT_EQ(double(found.events.size()), row.number("crossings"));
    }
    ++rows;
  }
  EXPECT_EQ(rows, 6);
}

/// x'' + x = (1 - x^2) x': period of the limit cycle to all digits (Andersen and Geer 1982), the multiplier 1 of its
/// shift in time, and Liouville's exp(integral of (1 - x^2)) as the other.
TEST(EveryMethod, FindsTheLimitCycleOfVanDerPol)
{
  SmallSystem     system  = van_der_pol(1.);
  PeriodicProblem problem = problem_of_period(system, 6.5);
  problem.phase           = 0;
  const PeriodicGuess    guess{VectorXd::Zero(1), VectorXd::Constant(1, 2.), 6.5};
  const PeriodicSolution balanced = solved(by_balance, problem, guess);
  double                 integral = balanced.period; // of 1, less the mean square of the series
  for (int h = 1; h <= balanced.series->harmonics(); ++h)
    integral -=
        0.5 * balanced.period * (std::pow(balanced.series->cosine(0, h), 2) + std::pow(balanced.series->sine(0, h), 2));
  for (const Way &way : {by_chosen, Way{&shooting_method(), 9, 1e-10}, by_collocation, by_balance})
  {
    SCOPED_TRACE(way.method->name() + std::to_string(way.segments));
    const PeriodicSolution found = solved(way, problem, guess);
    EXPECT_NEAR(found.period, 6.66328685932313, way.state);
    EXPECT_NEAR(found.q[0], 0., way.state);
    EXPECT_NEAR(found.v[0], balanced.v[0], 1e-8);
    ASSERT_EQ(found.multipliers.size(), 2);
    EXPECT_TRUE(found.trivial_multiplier);
    EXPECT_TRUE(found.stable());
    EXPECT_LT(std::abs(found.multipliers[0] - 1.), 1e-8);
    EXPECT_NEAR(found.multipliers[1].real(), std::exp(integral), 1e-8);
  }
}

/// phi'' J = M_0 - c phi' - k sin(phi), with a phase off zero.  With bearing damping the free motion has a zero and a
/// decaying eigenvalue, without two zeros.
TEST(EveryMethod, FindsTheSpeedOfARotorThatIsUnconstrained)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  for (const double bearing : {0.3, 0.})
  {
    SmallSystem system(2. * one, bearing * one, 0. * one);
    system.set_law(VectorXd::Ones(1), [](double u, double v, double &p, double &dp_du, double &dp_dv)
                   { p = 9. - 1.2 * v - 4. * std::sin(u), dp_du = -4. * std::cos(u), dp_dv = -1.2; });
    PeriodicProblem problem = problem_of_period(system, 1.);
    problem.begin           = 0.7;
    problem.turn            = VectorXd::Constant(1, 2. * M_PI);
    problem.phase           = 0;
    problem.phase_value     = 0.2;
    const PeriodicGuess guess{VectorXd::Constant(1, 0.2), VectorXd::Constant(1, 6.), 1.};
    const auto          by_shot = solved(by_chosen, problem, guess);
    EXPECT_LT(2. * M_PI / by_shot.period, 9. / (1.2 + bearing)); // the mean weight slows the rotor
    for (const Way &way : {by_collocation, by_balance})
    {
      const auto found = solved(way, problem, guess);
      EXPECT_NEAR(found.period, by_shot.period, 1e-9 * by_shot.period) << way.method->name();
      EXPECT_NEAR(found.q[0], 0.2, 1e-10) << way.method->name();
      EXPECT_NEAR(found.v[0], by_shot.v[0], 1e-8) << way.method->name();
    }
  }
}

} // namespace gestell::tests
