#include "coupling/periodic/averaging/averaging.h"
#include "coupling/periodic/averaging/slow_flow.h"
#include "coupling/periodic/verified_orbit.h"
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

} // namespace

/// All roots of [(omega(A) - Omega)^2 + zeta^2] A^2 = (F/2)^2, omega(A) = 1 + 3 beta A^2/8, and no other.
TEST(Averaging, HasEveryAmplitudeOfTheDuffingTable)
{
  int rows = 0;
  for (const auto &[name, given] : duffing_cases)
  {
    CubicSystem           system  = duffing_system(given);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / given.Omega);
    SlowFlow              flow(problem);
    std::vector<double>   expected;
    for (const ReferenceRow &row : read_reference("periodic/duffing_averaging.csv"))
      if (row["case"] == name)
        expected.push_back(row.number("A_averaging(first order, near resonance)"));
    const std::vector<double> found = flow.amplitudes();
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-12) << name;
    rows += int(found.size());
  }
  EXPECT_EQ(rows, 10);
}

/// Just inside a fold two amplitudes are nearer to each other than points of the search: (F/2)^2 a little below the
/// largest [(alpha y - d)^2 + zeta^2] y over y = A^2, alpha = 3 beta/8, d = Omega - 1.
TEST(Averaging, FindsAmplitudesThatAreAboutToMeet)
{
  const double beta = 0.5, zeta = 0.05, d = 0.4, alpha = 3. * beta / 8.;
  const double y = (4. * d - std::sqrt(4. * d * d - 12. * zeta * zeta)) / (6. * alpha);
  const double R = (std::pow(alpha * y - d, 2) + zeta * zeta) * y;

  for (const double share : {-1e-7, 1e-7})
  {
    CubicSystem           system  = duffing_system({zeta, beta, 2. * std::sqrt(R * (1. + share)), 1. + d});
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / (1. + d));
    SlowFlow              flow(problem);
    const auto            found = flow.amplitudes();
    ASSERT_EQ(found.size(), share < 0. ? 3u : 1u);
    if (share < 0.)
    {
      EXPECT_LT(found[1] - found[0], 2e-3 * found[0]);
      EXPECT_NEAR(0.5 * (found[0] + found[1]), std::sqrt(y), 1e-6);
    }
  }
}

TEST(Averaging, HasTheBackboneOfDuffing)
{
  CubicSystem           system  = duffing_system(duffing_cases.at("duffing1"));
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.4);
  SlowFlow              flow(problem);
  for (const double A : {0.1, 1., 3.})
  {
    EXPECT_NEAR(flow.at(A).omega, 1. + 3. * 0.5 * A * A / 8., 1e-12);
    EXPECT_NEAR(flow.at(A).delta, 0.05, 1e-15);
  }
}

/// Where three amplitudes coexist the middle one is unstable; the series meets the amplitude, and its phase the load:
/// the motion is in quadrature where it resonates.
TEST(Averaging, ReturnsSolutionsWithTheirStability)
{
  const DuffingCase    &given   = duffing_cases.at("duffing4");
  CubicSystem           system  = duffing_system(given);
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / given.Omega);
  const auto            found   = averaging_method().solve(problem, {}, {});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].stable());
  EXPECT_FALSE(found[1].stable());
  EXPECT_TRUE(found[2].stable());
  for (const PeriodicSolution &solution : found)
  {
    const double a = solution.series->cosine(0, 1), b = solution.series->sine(0, 1), A = std::hypot(a, b);
    // power in = power lost:  F sin-part Omega/2 = zeta Omega^2 A^2, of first order with Omega = omega_0 in the load
    EXPECT_NEAR(0.5 * given.F * b, given.zeta * A * A, 1e-12);
    EXPECT_NEAR(solution.q[0], a, 1e-15);
    EXPECT_NEAR(solution.v[0], given.Omega * b, 1e-15);
    // the weak case, near resonance: multipliers are those of the exact motion to the first order
    for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
      if (row["case"] == "duffing4" && int(row.number("solution")) == int(&solution - found.data()) + 1)
      {
        EXPECT_NEAR(std::abs(solution.multipliers[0]),
                    std::max(std::hypot(row.number("mu1_re"), row.number("mu1_im")),
                             std::hypot(row.number("mu2_re"), row.number("mu2_im"))),
                    0.01);
      }
  }
}

/// Multipliers of averaging are those of one mode: a run finds another one that grows.
TEST(Averaging, IsNotCalledStableWhereAnotherModeGrows)
{
  for (const double growth : {-0.05, 0.2})
  {
    MatrixXd B(2, 2), C(2, 2);
    B << 0.02, 0.005, 0.005, -growth;
    C << 1., 0., 0., 7.;
    CubicSystem system(MatrixXd::Identity(2, 2), B, C, {{0.02, Eigen::Vector2d(1., 0.)}});
    system.loads().add_harmonic(0, 1.03, 0.03, 0.);
    const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.03);
    auto                  found   = averaging_method().solve(problem, {}, {});
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(found[0].stable());
    verify_stable(problem, found);
    EXPECT_EQ(found[0].stable(), growth < 0.) << found[0].verification.departure << found[0].verification.failure;
  }
}

/// x'' + x = eps (1 - x^2) x': amplitude 2, frequency 1, exponent -eps of the first order.
TEST(Averaging, FindsTheLimitCycleOfVanDerPol)
{
  const double    eps     = 0.1;
  SmallSystem     system  = van_der_pol(eps);
  PeriodicProblem problem = problem_of_period(system, 6.);
  problem.phase           = 0;
  problem.phase_value     = 1.;
  problem.begin           = 0.3;
  const auto found        = averaging_method().solve(problem, {}, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].period, 2. * M_PI, 1e-11);
  EXPECT_NEAR(found[0].q[0], 1., 1e-12);
  EXPECT_NEAR(found[0].v[0], std::sqrt(3.), 1e-11); // rising, of amplitude 2
  EXPECT_NEAR(found[0].largest_multiplier(), std::exp(-2. * M_PI * eps), 1e-8);
  EXPECT_TRUE(found[0].trivial_multiplier);
}

/// A weight on a spring with x^3 and the mean of a one-sided stop: the equations of one harmonic and a mean, solved
/// here for the mean with the closed formulas.
TEST(Averaging, KeepsTheMeanThatTheForcesHave)
{
  const MatrixXd one  = MatrixXd::Identity(1, 1);
  const double   beta = 0.05, weight = 0.4;
  SmallSystem    system(one, 0.02 * one, one);
  system.set_law(VectorXd::Ones(1),
                 law_of([&](double u) { return -beta * u * u * u; }, [&](double u) { return -3. * beta * u * u; }));
  system.loads().add_constant(0, weight);
  system.loads().add_harmonic(0, 1.1, 0.05, 0.);
  const PeriodicProblem problem = problem_of_period(system, 2. * M_PI / 1.1);
  SlowFlow              flow(problem);
  const double          phi = flow.shape()[0], a = 0.8 / std::abs(phi), A = 0.8;
  flow.at(a);
  const double x_0 = flow.mean()[0];
  EXPECT_NEAR(x_0 + beta * (x_0 * x_0 * x_0 + 1.5 * x_0 * A * A), weight, 1e-12);
  EXPECT_NEAR(flow.at(a).omega,
              flow.omega_0() + (3. * beta * x_0 * x_0 + 0.75 * beta * A * A + 1. - std::pow(flow.omega_0(), 2)) /
                                   (2. * flow.omega_0()),
              1e-12);
}

TEST(Averaging, RefusesWhatItCannotAverage)
{
  CubicSystem duffing = duffing_system(duffing_cases.at("duffing1"));
  duffing.loads().add_harmonic(0, 2., 0.1, 0.);
  EXPECT_THAT(averaging_method().refuses(problem_of_period(duffing, 1.)), testing::HasSubstr("one frequency"));

  CubicSystem     still   = CubicSystem(MatrixXd::Identity(1, 1), MatrixXd::Identity(1, 1), MatrixXd::Identity(1, 1),
                                        {{1., VectorXd::Ones(1)}});
  PeriodicProblem problem = problem_of_period(still, 6.);
  problem.phase           = 0;
  EXPECT_THAT(averaging_method().refuses(problem), testing::HasSubstr("no mode is self-excited"));

  CubicSystem other = duffing_system(duffing_cases.at("duffing1"));
  problem           = problem_of_period(other, 1.);
  problem.turn[0]   = 6.;
  EXPECT_THAT(averaging_method().refuses(problem), testing::HasSubstr("rotating"));
}

} // namespace gestell::tests
