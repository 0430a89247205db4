#include "coupling/integration/bdf/bdf_controlled.h"

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/stability/stability.h"
#include "tests/support/modal_system.h"
#include "tests/support/reference_table.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

MethodOptions bdf_of(int order)
{
  MethodOptions options;
  options.order = order;
  return options;
}

Eigen::Vector2d exact_q(double t)
{
  return {std::sin(2. * t), std::exp(-t)};
}
Eigen::Vector2d exact_v(double t)
{
  return {2. * std::cos(2. * t), -std::exp(-t)};
}

/// Two coupled masses, strongly damped so that every order is stable, driven along q = (sin 2t, e^-t).
ModalSystem driven_chain()
{
  Matrix M(2, 2), B(2, 2), C(2, 2);
  M << 2., 0.3, 0.3, 1.;
  B << 60., -10., -10., 40.;
  C << 300., -100., -100., 250.;
  ModalSystem system(M, B, C);
  system.set_load(
      [=](double t) -> Vector
      {
        const Eigen::Vector2d a(-4. * std::sin(2. * t), std::exp(-t));
        return M * a + B * exact_v(t) + C * exact_q(t);
      });
  return system;
}

struct Outcome
{
  double          q = 0., v = 0.; ///< largest errors for 1 <= t <= 2
  double          mean_step = 0.; ///< there
  IntegrationWork work;
};

Outcome end_errors(const BdfControlled::Options &options)
{
  const ModalSystem system = driven_chain();
  BdfControlled     bdf(system, options);
  bdf.begin(0., exact_q(0.), exact_v(0.));
  Outcome outcome;
  double  first = 0.;
  int     steps = 0;
  while (bdf.time() < 2.)
  {
    bdf.advance();
    const double t = bdf.time();
    if (t < 1.) // past what the start leaves behind
      continue;
    if (first == 0.)
      first = t;
    else
      ++steps;
    outcome.q = std::max(outcome.q, (bdf.instant().q - exact_q(t)).norm());
    outcome.v = std::max(outcome.v, (bdf.instant().v - exact_v(t)).norm());
  }
  outcome.mean_step = (bdf.time() - first) / steps;
  outcome.work      = bdf.work();
  return outcome;
}

using ControlledOrder = ::testing::TestWithParam<int>;

// Steps are powers of two; between these tolerances the mean step falls about eight times.
TEST_P(ControlledOrder, ErrorFallsWithThePowerOfTheMeanStep)
{
  BdfControlled::Options options;
  options.max_order    = GetParam();
  options.fixed_order  = true;
  options.largest_step = 0.5;
  options.tolerance    = GetParam() == 1 ? 1e-2 : GetParam() == 2 ? 1e-4 : 1e-5;
  const Outcome coarse = end_errors(options);
  options.tolerance *= std::pow(8., -GetParam());
  const Outcome fine  = end_errors(options);
  const double  ratio = std::log(coarse.mean_step / fine.mean_step);
  EXPECT_GT(ratio, std::log(3.5));
  EXPECT_NEAR(std::log(coarse.q / fine.q) / ratio, GetParam(), 0.15);
  EXPECT_NEAR(std::log(coarse.v / fine.v) / ratio, GetParam(), 0.15);
}
INSTANTIATE_TEST_SUITE_P(Orders, ControlledOrder, ::testing::Values(1, 2, 3, 4, 5));

TEST(BdfControlled, ErrorStaysProportionalToTheTolerance)
{
  BdfControlled::Options options;
  options.largest_step = 0.5;
  double smallest = 1e300, largest = 0.;
  for (double tolerance = 1e-3; tolerance > 0.5e-9; tolerance *= 0.1)
  {
    options.tolerance     = tolerance;
    const Outcome outcome = end_errors(options);
    smallest              = std::min(smallest, outcome.q / tolerance);
    largest               = std::max(largest, outcome.q / tolerance);
  }
  EXPECT_LT(largest, 10. * smallest);
  EXPECT_LT(largest, 1.);
}

// The exact solutions are Jacobi's elliptic functions.  Nothing damps these vibrations, so what errors of the period
// leave adds up over two to three periods: some ten times the tolerance.
TEST(BdfControlled, MeetsTheEllipticSolutionsOfDuffing)
{
  const std::map<std::string, std::pair<double, double>> cases{
      {"duffing1", {1., 1.}}, {"duffing2", {1., -0.2}}, {"duffing3", {-1., 1.}}};
  for (const auto &[name, parameters] : cases)
    for (const double tolerance : {1e-4, 1e-6, 1e-8})
    {
      const ModalSystem system = duffing(parameters.first, parameters.second);
      BdfControlled     bdf(system, {tolerance, 0.5});
      LocalState        local;
      local.resize(1);
      double largest = 0.;
      bool   begun   = false;
      for (const ReferenceRow &row : read_reference("order/b_duffing_pendulum.csv"))
      {
        if (row["case"] != name)
          continue;
        const double t = row.number("t"), x = row.number("x"), v = row.number("v");
        if (!std::exchange(begun, true))
        {
          bdf.begin(t, Vector::Constant(1, x), Vector::Constant(1, v));
          continue;
        }
        while (bdf.time() < t)
          bdf.advance();
        bdf.interpolate(t, local);
        largest = std::max({largest, std::abs(local.u[0] - x), std::abs(local.v[0] - v)});
      }
      ASSERT_TRUE(begun);
      EXPECT_GT(largest, 0.);
      EXPECT_LT(largest, 50. * tolerance) << name;
    }
}

TEST(BdfControlled, StepsThatComeBackFindTheirFactorisations)
{
  const ModalSystem system = duffing(1., 1.);
  BdfControlled     bdf(system, {1e-4, 0.5, 0., 2});
  bdf.begin(0., Vector::Constant(1, 2.), Vector::Zero(1));
  const double     period = 3.1797233167817153;
  std::set<double> steps;
  const auto       run = [&](double end)
  {
    while (bdf.time() < end)
    {
      bdf.advance();
      steps.insert(bdf.step());
    }
    return bdf.work().factorisations;
  };
  const long early = run(3. * period), late = run(12. * period);
  EXPECT_GT(steps.size(), 2u); // the step does change
  EXPECT_EQ(late, early);
  // one per rung by BDF2, and Euler's three of every start that was tried, on neighbouring rungs
  EXPECT_LE(early, long(steps.size()) + 3 * (1 + bdf.work().rejected));
}

// Wall spring met by a driven oscillator: contacts and releases in closed form between events.
TEST(BdfControlled, TimesOfImpactsFallWithTheTolerance)
{
  std::vector<double> exact;
  for (const ReferenceRow &row : read_reference("order/c_impact_events.csv"))
    if (row["case"] == "impact2")
      exact.push_back(row.number("t"));
  ASSERT_EQ(exact.size(), 12u);
  const double gap = 0.05, stiffness = 4e6;
  for (const double tolerance : {1e-4, 1e-7, 1e-9})
  {
    ModalSystem system = oscillator(10., 20., 4000., nullptr);
    system.watched     = true;
    system.level       = gap;
    system.law         = [&](double u, double, double &p, double &dp_du, double &dp_dv)
    {
      const bool closed = system.transitions % 2 == 1;
      p                 = closed ? -stiffness * (u - gap) : 0.;
      dp_du             = closed ? -stiffness : 0.;
      dp_dv             = 0.;
    };
    system.loads().add_harmonic(0, 18., 400., 0.);
    BdfControlled bdf(system, {tolerance, 0.05});
    EventDriver   driver(system, bdf, {});
    driver.begin(0., Vector::Zero(1), Vector::Zero(1));
    while (bdf.time() < 2.)
      driver.advance();
    ASSERT_EQ(driver.events().size(), exact.size()) << tolerance;
    // Each impact multiplies errors of the motion before it; twelve of them by less than ten.
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(driver.events()[i].t, exact[i], (i < 4 ? 0.1 : 1.) * tolerance) << "event " << i;
  }
}

/// Sixteen modes of 1 % damping from 40 to 2047 rad/s, so close that no step lies in a gap; each driven by F cos(60 t),
/// F its stiffness.
ModalSystem frame_of_many_modes()
{
  constexpr int n = 16;
  Vector        omega(n);
  for (int i = 0; i < n; ++i)
    omega[i] = 40. * std::pow(1.3, i);
  ModalSystem system(Matrix::Identity(n, n), (0.02 * omega).asDiagonal(), omega.cwiseAbs2().asDiagonal());
  for (int i = 0; i < n; ++i)
    system.loads().add_harmonic(i, 60., system.C(i, i), 0.);
  return system;
}

TEST(BdfControlled, OrdersThatWouldMakeAModeGrowAreNotUsed)
{
  const ModalSystem system   = frame_of_many_modes();
  const auto        spectrum = system.linear().spectrum();
  BdfControlled     bdf(system, {1e-3, 0.01});
  bdf.begin(0., Vector::Zero(16), Vector::Zero(16));
  std::map<std::pair<int, double>, long> steps; // by order and length
  while (bdf.time() < 3.)
  {
    bdf.advance();
    ++steps[{bdf.order(), bdf.step()}];
    // Switched on at once, a mode overshoots to less than twice what it does in the end; 52 rad/s is next to resonance.
    EXPECT_LT(std::abs(bdf.instant().q[15]), 2.);
  }
  double growth = 0.; // ln of that of order 3 with the steps that order 2 took
  for (const auto &[kind, n] : steps)
  {
    const auto [order, h] = kind;
    double largest        = 0.; // of ln|r| among the modes
    for (const SpectrumLine &mode : spectrum)
      largest = std::max(largest, step_properties(bdf_of(std::max(order, 3)), {mode.zeta, mode.omega * h}).log_growth);
    const bool grows = largest > 1e-9;
    if (order > 2)
    {
      EXPECT_FALSE(grows) << order << " with " << h;
    }
    else if (grows)
      growth += static_cast<double>(n) * largest;
  }
  EXPECT_GT(growth, 20.);
  for (int i = 8; i < 16; ++i)
  {
    const double               omega    = std::sqrt(system.C(i, i));
    const std::complex<double> response = omega * omega / std::complex<double>(omega * omega - 3600., 1.2 * omega);
    const std::complex<double> exact    = response * std::exp(std::complex<double>(0., 60. * bdf.time()));
    EXPECT_NEAR(bdf.instant().q[i], exact.real(), 1e-3) << i;
  }
}

TEST(BdfOrderLimit, AgreesWithTheRootsOfTheFormula)
{
  for (int order = 1; order <= 6; ++order)
    for (const double zeta : {0., 1e-3, 0.01, 0.05, 0.3, 0.9, 1.5})
      for (double omega_h = 1e-3; omega_h < 100.; omega_h *= 1.3)
      {
        const SpectrumLine mode{omega_h, zeta};
        const double       radius = spectral_radius(bdf_of(order), {zeta, omega_h});
        if (std::abs(radius - 1. - 1e-9) < 1e-8)
          continue;
        EXPECT_EQ(bdf_decays(order, mode, 1.), radius < 1.) << order << " " << zeta << " " << omega_h;
      }
}

TEST(BdfOrderLimit, SpectraWithGapsAllowNothingAboveTwo)
{
  const std::vector<SpectrumLine> spectrum{{10., 0.9}};
  EXPECT_TRUE(BdfOrderLimit(spectrum, 1, 1e-3).allows(3, 0));
  EXPECT_FALSE(BdfOrderLimit(spectrum, 2, 1e-3).allows(3, 0));
  EXPECT_TRUE(BdfOrderLimit(spectrum, 2, 1e-3).allows(2, 0));
}

} // namespace
} // namespace gestell::tests
