#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/harmonic/hill.h"
#include "tests/support/coupled_system.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double amplitude(const FourierSeries &series, int coordinate, int harmonic)
{
  return std::hypot(series.cosine(coordinate, harmonic), series.sine(coordinate, harmonic));
}

/// q, q', q'' of one coordinate at t, by the series itself.
Eigen::Vector3d motion_at(const FourierSeries &series, int i, double t)
{
  Eigen::Vector3d x(series.cosine(i, 0) + series.ramp[i] * (t - series.begin), series.ramp[i], 0.);
  for (int h = 1; h <= series.harmonics(); ++h)
  {
    const double w = h * series.omega, c = std::cos(w * t), s = std::sin(w * t);
    const double a = series.cosine(i, h), b = series.sine(i, h);
    x += Eigen::Vector3d(a * c + b * s, w * (b * c - a * s), -w * w * (a * c + b * s));
  }
  return x;
}

PeriodicOptions with_harmonics(int H)
{
  PeriodicOptions options;
  options.own["harmonics"] = H;
  options.tolerance        = 1e-11;
  return options;
}

FourierSeries balanced(const PeriodicProblem &problem, const PeriodicGuess &guess, int harmonics)
{
  const auto found = harmonic_balance_method().solve(problem, guess, with_harmonics(harmonics));
  EXPECT_EQ(found.size(), 1u);
  return *found.at(0).series;
}

} // namespace

/// The same H gives the same amplitudes, of unstable solutions too, from the state of the exact motion at t = 0.
TEST(HarmonicBalance, HasTheAmplitudesOfTheDuffingTable)
{
  int compared = 0;
  for (const ReferenceRow &exact : read_reference("periodic/duffing_shooting.csv"))
  {
    const DuffingCase    &given   = duffing_cases.at(exact["case"]);
    CubicSystem           system  = duffing_system(given);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / given.Omega);
    const PeriodicGuess guess{VectorXd::Constant(1, exact.number("x(0)")), VectorXd::Constant(1, exact.number("v(0)")),
                              0.};
    for (const ReferenceRow &row : read_reference("periodic/duffing_harmonic_balance.csv"))
      if (row["case"] == exact["case"] && row["solution"] == exact["solution"])
      {
        const int           H      = int(row.number("H"));
        const FourierSeries series = balanced(problem, guess, H);
        EXPECT_NEAR(amplitude(series, 0, 1), row.number("harmonic1"), 1e-9) << row["case"] << row["solution"] << H;
        if (row.has("harmonic3"))
        {
          EXPECT_NEAR(amplitude(series, 0, 3), row.number("harmonic3"), 1e-9) << row["case"] << row["solution"] << H;
        }
        ++compared;
      }
  }
  EXPECT_EQ(compared, 50);
}

TEST(HarmonicBalance, HasTheAmplitudesOfTheTableOfTwoMasses)
{
  int compared = 0;
  for (const ReferenceRow &exact : read_reference("periodic/two_dof_shooting.csv"))
  {
    const double          Omega   = exact.number("Omega");
    CubicSystem           system  = two_dof_system(exact["case"], Omega);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / Omega);
    const PeriodicGuess   guess{Eigen::Vector2d(exact.number("q1(0)"), exact.number("q2(0)")),
                              Eigen::Vector2d(exact.number("v1(0)"), exact.number("v2(0)")), 0.};
    for (const ReferenceRow &row : read_reference("periodic/two_dof_harmonic_balance.csv"))
      if (row["case"] == exact["case"] && row["Omega"] == exact["Omega"] && row["solution"] == exact["solution"])
      {
        const FourierSeries series = balanced(problem, guess, int(row.number("H")));
        EXPECT_NEAR(amplitude(series, 0, 1), row.number("harmonic1_q1"), 1e-9) << row["case"] << Omega << row["H"];
        EXPECT_NEAR(amplitude(series, 1, 1), row.number("harmonic1_q2"), 1e-9) << row["case"] << Omega << row["H"];
        ++compared;
      }
  }
  EXPECT_EQ(compared, int(read_reference("periodic/two_dof_harmonic_balance.csv").size()));
}

namespace
{

/// Peak and folds of a branch over the frequency of the drive, by pseudo-arclength with dr/dT of the class.
struct FollowedBranch
{
  double              peak = 0., peak_omega = 0.;
  std::vector<double> folds; ///< omega
};

FollowedBranch follow(HarmonicBalance &balance, double omega_begin, double omega_end, double step)
{
  FollowedBranch branch;
  VectorXd       r, z;
  MatrixXd       J;
  balance.set_period(2. * M_PI / omega_begin);
  z = balance.linear_start();
  for (int k = 0; k < 20; ++k)
  {
    balance.linearise(z, r, J);
    z -= J.lu().solve(r);
  }
  const auto n = z.size();
  VectorXd   x(n + 1), tangent = VectorXd::Unit(n + 1, n);
  x << z, omega_begin;
  double before[3] = {}, amplitudes[3] = {};
  for (int steps = 0; x[n] < omega_end && steps < 5000; ++steps)
  {
    VectorXd       next    = x + step * tangent;
    const VectorXd planned = next;
    MatrixXd       full(n + 1, n + 1);
    VectorXd       residual(n + 1), column = VectorXd::Unit(n + 1, n);
    for (int k = 0; k < 6; ++k)
    {
      balance.set_period(2. * M_PI / next[n]);
      balance.linearise(next.head(n), r, J);
      full << J, balance.period_slope(next.head(n)) * (-2. * M_PI / (next[n] * next[n])), tangent.transpose();
      residual << r, tangent.dot(next - planned);
      next -= full.lu().solve(residual);
    }
    tangent = full.lu().solve(column).normalized();
    x       = next;
    for (int i = 0; i < 2; ++i)
      before[i] = before[i + 1], amplitudes[i] = amplitudes[i + 1];
    before[2]     = x[n];
    amplitudes[2] = std::hypot(x[1], x[2]);
    // vertex of the parabola through three points
    const auto vertex = [](const double *y) { return 0.5 * (y[0] - y[2]) / (y[0] - 2. * y[1] + y[2]); };
    const auto value  = [](const double *y, double s)
    { return y[1] + 0.5 * s * (y[2] - y[0]) + 0.5 * s * s * (y[0] - 2. * y[1] + y[2]); };
    if (steps > 2 && (before[1] - before[0]) * (before[2] - before[1]) < 0.)
      branch.folds.push_back(value(before, vertex(before)));
    if (steps > 2 && amplitudes[1] > amplitudes[0] && amplitudes[1] > amplitudes[2])
    {
      branch.peak       = value(amplitudes, vertex(amplitudes));
      branch.peak_omega = value(before, vertex(amplitudes));
    }
  }
  return branch;
}

} // namespace

/// x'' + 0.05 x' + x + 0.1 x^3 = 0.18 cos: published to four digits behind the point (NLvib, example 1).
TEST(HarmonicBalance, HasPeakAndFoldsOfThePublishedDuffingOscillator)
{
  CubicSystem           system  = duffing_system({0.025, 0.1, 0.18, 1.});
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI);
  HarmonicBalance       balance(problem, 7);

  const FollowedBranch branch = follow(balance, 0.8, 1.4, 0.02);

  EXPECT_NEAR(branch.peak, 2.8302, 0.6e-4);
  EXPECT_NEAR(branch.peak_omega, 1.2687, 0.6e-4);
  ASSERT_EQ(branch.folds.size(), 2u);
  EXPECT_NEAR(branch.folds[0], 1.2696, 0.6e-4);
  EXPECT_NEAR(branch.folds[1], 1.1157, 0.6e-4);
}

namespace
{

/// Largest |M q'' + B q' + C q - f - p| at instants that are no samples, against the largest inertia force.
double unbalanced(SmallSystem &system, const FourierSeries &series)
{
  double largest = 0., inertia = 0.;
  for (int k = 0; k < 97; ++k)
  {
    const double          t = series.begin + 2. * M_PI / series.omega * k / 97.;
    const Eigen::Vector3d x = motion_at(series, 0, t);
    VectorXd              f(1);
    system.excitation().at(t, f);
    double p = 0., dp_du, dp_dv;
    system.law(x[0], x[1], p, dp_du, dp_dv);
    largest =
        std::max(largest, std::abs(system.M(0, 0) * x[2] + system.B(0, 0) * x[1] + system.C(0, 0) * x[0] - f[0] - p));
    inertia = std::max(inertia, std::abs(system.M(0, 0) * x[2]));
  }
  return largest / inertia;
}

} // namespace

/// dr/dz and dr/dT against central quotients, of a law of two measures with u', in a base with a damped free motion, an
/// undamped one and a spring.
TEST(HarmonicBalance, LinearisesExactly)
{
  CoupledSystem   system(0.1);
  PeriodicProblem problem = problem_of_period(system, 3.);
  problem.turn[1]         = 2. * M_PI;
  problem.phase           = 1;
  HarmonicBalance balance(problem, 3);

  std::mt19937                     random(7);
  std::uniform_real_distribution<> number(-1., 1.);
  VectorXd z      = VectorXd::NullaryExpr(balance.size(), [&] { return number(random); }), r, above, below;
  z[z.size() - 1] = 3.;
  MatrixXd J;
  balance.linearise(z, r, J);
  const double e = 1e-5;
  for (Eigen::Index k = 0; k < z.size(); ++k)
  {
    VectorXd moved = z;
    moved[k] += e;
    balance.residual(moved, above);
    moved[k] -= 2. * e;
    balance.residual(moved, below);
    EXPECT_LT((J.col(k) - (above - below) / (2. * e)).norm(), 1e-7 * (1. + J.col(k).norm())) << k;
  }
  EXPECT_LT((balance.period_slope(z) - J.col(z.size() - 1)).norm(), 1e-12 * J.norm());
}

/// Loads of 1 and 3/2 times a frequency repeat after two of its periods; the linear response is exact.
TEST(HarmonicBalance, IsExactWhereTheSystemIsLinear)
{
  const MatrixXd one = MatrixXd::Identity(1, 1);
  SmallSystem    system(2. * one, 0.3 * one, 5. * one);
  system.loads().add_harmonic(0, 2., 1.5, 0.5);
  system.loads().add_harmonic(0, 3., -0.5, 1.);
  system.loads().add_constant(0, 2.);
  system.set_law(VectorXd::Ones(1), law_of([](double u) { return -u; }, [](double) { return -1.; }));
  PeriodicProblem problem    = problem_of_period(system, 2. * M_PI);
  problem.begin              = 0.4;
  const FourierSeries series = balanced(problem, {}, 3);
  EXPECT_LT(unbalanced(system, series), 1e-12);
  EXPECT_NEAR(series.cosine(0, 0), 2. / 6., 1e-14);
}

/// A motion that is known is packed into the unknowns that it came from.
TEST(HarmonicBalance, BeginsWithASeries)
{
  CubicSystem     system  = two_dof_system("two_dof1", 1.1);
  PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.1);
  problem.begin           = 0.3;
  HarmonicBalance balance(problem, 5);
  VectorXd        z = balance.linear_start(), r;
  ASSERT_TRUE(solve_balance(balance, with_harmonics(5), z).converged);
  EXPECT_LT((balance.pack(balance.series(z)) - z).norm(), 1e-10 * z.norm());
}

/// Eight, sixteen ... harmonics until what is left out is below the tolerance; the note tells it.
TEST(HarmonicBalance, ChoosesTheNumberOfHarmonics)
{
  CubicSystem           system  = duffing_system(duffing_cases.at("duffing3"));
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 0.45);
  const auto            found   = harmonic_balance_method().solve(problem, {}, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].series->harmonics(), 32);
  EXPECT_NEAR(amplitude(*found[0].series, 0, 1), 0.60617472563889, 1e-10);
  ASSERT_EQ(found[0].notes.size(), 1u);
  EXPECT_THAT(found[0].notes[0], testing::HasSubstr("32 harmonics"));
}

TEST(HarmonicBalance, RefusesWhatItCannotBalance)
{
  CubicSystem duffing = duffing_system(duffing_cases.at("duffing1"));
  expect_refusal([&] { HarmonicBalance(problem_of_period(duffing, 4.), 5); }, "an integer is needed");
  expect_refusal([&] { HarmonicBalance(problem_of_period(duffing, 2. * M_PI / 1.4), 0); }, "at least 1");

  PeriodicProblem phase = problem_of_period(duffing, 4.);
  phase.phase           = 0;
  EXPECT_THAT(harmonic_balance_method().refuses(phase), testing::HasSubstr("phase condition"));

  PeriodicProblem turning = problem_of_period(duffing, 2. * M_PI / 1.4);
  turning.turn[0]         = 2. * M_PI;
  expect_refusal([&] { HarmonicBalance(turning, 5); }, "stretches a linear spring at q0");

  CubicSystem undamped = duffing_system({0., 0.5, 0.3, 0.5});
  expect_refusal([&] { HarmonicBalance(problem_of_period(undamped, 4. * M_PI), 5).linear_start(); },
                 "coincides with harmonic 2");

  PeriodicOptions few;
  few.own["harmonics"] = 3;
  CubicSystem fast     = duffing_system(duffing_cases.at("duffing1"));
  fast.loads().add_harmonic(0, 5. * 1.4, 1., 0.);
  expect_refusal([&] { harmonic_balance_method().solve(problem_of_period(fast, 2. * M_PI / 1.4), {}, few); },
                 "3 harmonics would omit a load of harmonic 5");

  CubicSystem other = duffing_system(duffing_cases.at("duffing1"));
  other.set_load([](double t) { return VectorXd::Constant(1, t); });
  EXPECT_THAT(harmonic_balance_method().refuses(problem_of_period(other, 1.)), testing::HasSubstr("sum of harmonics"));
}

/// Damped modes alone: mu = exp(s T), s = -delta +- i sqrt(omega_0^2 - delta^2).
TEST(Hill, IsExactWhereTheSystemIsLinear)
{
  CubicSystem           system  = duffing_system({0.1, 0., 0.3, 0.8});
  const double          T       = 2. * M_PI / 0.8;
  const PeriodicProblem problem = problem_of_period(system, T);
  HarmonicBalance       balance(problem, 1);
  VectorXd              r;
  MatrixXd              J;
  balance.linearise(balance.linear_start(), r, J);
  const Eigen::VectorXcd     mu       = hill_multipliers(problem, 0.8, 1, balance.derivatives()).multipliers;
  const std::complex<double> expected = std::exp(std::complex<double>(-0.1, std::sqrt(1. - 0.01)) * T);
  EXPECT_LT((mu.array() - expected).abs().minCoeff(), 1e-12);
}

TEST(Hill, IsChosenForSmallSystemsOnly)
{
  CubicSystem one  = duffing_system(duffing_cases.at("duffing1"));
  SmallSystem many = SmallSystem(MatrixXd::Identity(50, 50), MatrixXd::Identity(50, 50), MatrixXd::Identity(50, 50));
  EXPECT_EQ(floquet_way(problem_of_period(one, 1.), 16), FloquetWay::hill);
  EXPECT_EQ(floquet_way(problem_of_period(many, 1.), 16), FloquetWay::shooting);
}

} // namespace gestell::tests
