// The test oscillator under every method: tables of spectral radius, unstable intervals, period and damping, overshoot
// (tests/reference/numerics/stability, computed with 30 to 40 digits), and theorems about them.

#include "coupling/integration/bdf/bdf_method.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/stability/overshoot.h"
#include "coupling/integration/stability/polynomial_roots.h"
#include "coupling/integration/stability/stability.h"
#include "tests/support/small_system.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>

namespace gestell::tests
{
namespace
{

using namespace coupling;

const double limit_theta = 0.5 * (1. + std::sqrt(3.));

/// Rows of a table whose cells may be quoted.
std::vector<std::vector<std::string>> rows_of(const std::string &name)
{
  std::ifstream                         file(GESTELL_SOURCE_DIR "/tests/reference/numerics/stability/" + name);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);)
  {
    rows.emplace_back(1);
    bool quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        rows.back().emplace_back();
      else
        rows.back().back() += c;
  }
  EXPECT_GT(rows.size(), 1u) << name;
  rows.erase(rows.begin());
  return rows;
}

/// The method that a table calls so; none for central differences with lagged damping, which Gestell does not have.
std::optional<MethodOptions> named(std::string name)
{
  MethodOptions o;
  name            = name.substr(0, name.find("(order ramp"));
  const auto has  = [&](const std::string &begin) { return name.rfind(begin, 0) == 0; };
  const auto tail = [&](const std::string &begin) { return std::stod(name.substr(begin.size())); };
  if (has("bdf"))
    o.order = static_cast<int>(tail("bdf"));
  else if (has("newmark"))
  {
    o.method = "newmark";
    o.set("beta", has("newmark_average") ? 0.25 : has("newmark_linear") ? 1. / 6. : has("newmark_g0.6") ? 0.3025 : 0.);
    o.set("gamma", has("newmark_g0.6") ? 0.6 : 0.5);
  }
  else if (has("wilson_theta_"))
  {
    o.method = "wilson";
    o.set("theta", has("wilson_theta_(") ? limit_theta : tail("wilson_theta_"));
  }
  else if (has("hht_alpha_"))
  {
    o.method = "hht";
    o.set("alpha", tail("hht_alpha_"));
  }
  else if (has("galpha_rhoinf_"))
  {
    o.method = "generalised-alpha";
    o.set("rho_inf", tail("galpha_rhoinf_"));
  }
  else if (name == "central_difference")
    o.method = "central-difference";
  else if (name == "central_difference_lagged_damping")
    return std::nullopt;
  else
    throw std::invalid_argument(name);
  return o;
}

/// Every method that is there, for properties that all have.
std::vector<MethodOptions> all_methods()
{
  std::vector<MethodOptions> methods;
  std::map<std::string, int> seen;
  for (const auto &row : rows_of("spectral_radius.csv"))
    if (const auto o = named(row[0]); o && seen[row[0]]++ == 0)
      methods.push_back(*o);
  return methods;
}

TEST(Stability, SpectralRadiusAgreesWithTheTable)
{
  int rows = 0;
  for (const auto &row : rows_of("spectral_radius.csv"))
    if (const auto o = named(row[0]))
    {
      const TestOscillator oscillator{std::stod(row[1]), std::stod(row[2])};
      // 13 digits are given; simple roots are known to long double, two that meet to sqrt(1e-19).
      const double wanted = std::stod(row[3]);
      EXPECT_NEAR(spectral_radius(*o, oscillator), wanted, 1e-9 * std::max(1., wanted))
          << row[0] << ' ' << row[1] << ' ' << row[2];
      ++rows;
    }
  EXPECT_EQ(rows, 26 * 100);
}

TEST(Stability, RadiusAtInfinityAndLimitOfWilson)
{
  for (const auto &row : rows_of("limits.csv"))
  {
    if (row[0].rfind("rho_inf(", 0) == 0)
    {
      std::string name = row[0].substr(8, row[0].size() - 9);
      if (name == "newmark_g0.6_b0.3025" || name.rfind("hht", 0) == 0 || name.rfind("galpha", 0) == 0)
      {
        // Three roots meet at infinity: at omega h = 1e8 they lie (1e8)^(-2/3) = 5e-6 away from there.
        EXPECT_NEAR(spectral_radius(*named(name), {0., 1e8}), std::stod(row[2]), 1e-5) << name;
      }
    }
    if (row[0].rfind("wilson_rho_inf_theta_", 0) == 0)
    {
      EXPECT_NEAR(spectral_radius(*named("wilson_theta_" + row[0].substr(21)), {0., 1e8}), std::stod(row[2]), 1e-9);
    }
  }
  for (int order = 1; order <= 6; ++order) // r^p omega_h -> const: zero as omega h grows
  {
    MethodOptions o;
    o.order = order;
    EXPECT_LT(spectral_radius(o, {0., 1e12}), 2e-2);
  }
}

TEST(Stability, UnstableIntervalsAgreeWithTheTable)
{
  std::map<std::string, std::vector<std::vector<std::string>>> cases;
  for (const auto &row : rows_of("unstable_intervals.csv"))
    cases[row[0] + " " + row[1]].push_back(row);
  for (const auto &[name, rows] : cases)
  {
    const auto o = named(rows[0][0]);
    if (!o)
      continue;
    const auto intervals = unstable_intervals(*o, std::stod(rows[0][1]));
    if (rows[0][2] == "none")
    {
      EXPECT_TRUE(intervals.empty()) << name << " from " << intervals[0].from;
      continue;
    }
    ASSERT_EQ(intervals.size(), rows.size()) << name;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      // The table's own ends were found by bisection in 1e-14 of growth: 1e-12 relative where growth is steep.
      const double from = std::stod(rows[i][2]);
      EXPECT_NEAR(intervals[i].from, from, 1e-9 * (1. + from)) << name;
      if (rows[i][3] == "inf")
        EXPECT_TRUE(std::isinf(intervals[i].to)) << name;
      else
      {
        EXPECT_NEAR(intervals[i].to, std::stod(rows[i][3]), 1e-9 * std::stod(rows[i][3])) << name;
        // The table's largest growth is that of a grid of omega h, a little below the peak.
        EXPECT_GE(intervals[i].growth, std::stod(rows[i][4]) - 1e-8) << name;
        EXPECT_NEAR(intervals[i].growth, std::stod(rows[i][4]), 1e-5) << name;
        EXPECT_NEAR(intervals[i].at_omega_h, std::stod(rows[i][5]), 0.02) << name;
      }
    }
  }
}

TEST(Stability, PeriodAndDampingAgreeWithTheTable)
{
  for (const auto &row : rows_of("dispersion_dissipation.csv"))
    if (const auto o = named(row[0]))
    {
      const auto        properties = step_properties(*o, {std::stod(row[1]), std::stod(row[2])});
      const std::string where      = row[0] + " " + row[1] + " " + row[2];
      if (row[3] == "overdamped")
      {
        EXPECT_TRUE(std::isnan(properties.period_elongation)) << where;
        continue;
      }
      // 12 digits are given; ln r and zeta come with 1e-19, which is what counts where nearly nothing is left.
      const double period = std::stod(row[3]), damping = std::stod(row[4]);
      EXPECT_NEAR(properties.period_elongation, period, 1e-11 * std::abs(period) + 1e-17) << where;
      EXPECT_NEAR(properties.numerical_damping, damping, 1e-11 * std::abs(damping) + 1e-17) << where;
    }
}

TEST(Stability, OvershootAgreesWithTheTable)
{
  for (const auto &row : rows_of("overshoot.csv"))
    if (const auto o = named(row[0]))
    {
      const auto start  = row[2] == "x0=1,v0=0" ? OscillatorStart::displaced : OscillatorStart::moving;
      const auto result = overshoot(*o, {0., std::stod(row[1])}, start, FirstSteps::order_ramp);
      // 11 digits; 20 steps of a state whose parts differ by omega_h^2 = 1e6 lose as many.
      const double x = std::stod(row[3]), v = std::stod(row[5]);
      EXPECT_NEAR(result.displacement, x, 1e-9 * std::max(1., x)) << row[0] << ' ' << row[1] << ' ' << row[2];
      EXPECT_NEAR(result.velocity, v, 1e-9 * std::max(1., v)) << row[0] << ' ' << row[1] << ' ' << row[2];
    }
}

TEST(Stability, OvershootOfBdfIsThatOfTheIntegratorItself)
{
  for (int order = 2; order <= 6; ++order)
    for (const double omega : {0.5, 2., 5.})
      for (const auto start : {OscillatorStart::displaced, OscillatorStart::moving})
      {
        const SmallSystem system(Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1),
                                 Eigen::MatrixXd::Constant(1, 1, omega * omega));
        MethodOptions     method;
        method.order          = order;
        method.step           = 1.;
        const auto integrator = make_integrator(system, method);
        const bool displaced  = start == OscillatorStart::displaced;
        integrator->begin(0., Eigen::VectorXd::Constant(1, displaced ? 1. : 0.),
                          Eigen::VectorXd::Constant(1, displaced ? 0. : omega));
        double x = displaced ? 1. : 0., v = 1. - x;
        for (int step = 0; step < 20; ++step)
        {
          integrator->advance();
          x = std::max(x, std::abs(integrator->instant().q[0]));
          v = std::max(v, std::abs(integrator->instant().v[0]) / omega);
        }
        const Overshoot told = overshoot(method, {0., omega}, start);
        EXPECT_NEAR(told.displacement, x, 1e-10 * x) << "BDF " << order << " at " << omega;
        EXPECT_NEAR(told.velocity, v, 1e-10 * v) << "BDF " << order << " at " << omega;
      }
}

TEST(Stability, SufficientDampingOfBdfAgreesWithTheTable)
{
  for (const auto &row : rows_of("bdf_sufficient_damping.csv"))
  {
    MethodOptions o;
    o.order            = std::stoi(row[0].substr(3));
    const double ratio = sufficient_damping(o.order);
    EXPECT_NEAR(ratio, std::stod(row[2]), 1e-12) << row[0];
    EXPECT_TRUE(unstable_intervals(o, ratio * (1. + 1e-9)).empty()) << row[0];
    if (ratio > 0.) // just below, a narrow interval about the critical omega h must not be stepped over
    {
      const auto intervals = unstable_intervals(o, ratio * (1. - 1e-9));
      ASSERT_EQ(intervals.size(), 1u) << row[0];
      EXPECT_LT(intervals[0].from, std::stod(row[3]));
      EXPECT_GT(intervals[0].to, std::stod(row[3]));
      EXPECT_LT(intervals[0].to - intervals[0].from, 1e-2);
    }
  }
}

TEST(Stability, MatrixAndCharacteristicRootsAreTheSameStep)
{
  for (const MethodOptions &o : all_methods())
    for (const double zeta : {0., 0.03, 0.4, 1.5})
      for (const double omega_h : {0.05, 0.7, 3., 40.})
      {
        const Eigen::VectorXcd roots = method_of(o).amplification_matrix(o, {zeta, omega_h}).eigenvalues();
        // Multiple roots of the matrix: at r = 0 for BDF's rest, elsewhere up to triple: 1e-16^(1/3).
        EXPECT_NEAR(roots.cwiseAbs().maxCoeff(), spectral_radius(o, {zeta, omega_h}), 1e-5)
            << method_name(o) << ' ' << zeta << ' ' << omega_h;
      }
}

TEST(Stability, NewmarkStepLimitIsTheClosedFormula)
{
  MethodOptions o;
  o.method = "newmark";
  o.set("gamma", 0.5);
  for (const double beta : {0., 1. / 12., 1. / 8., 1. / 6., 0.24})
  {
    o.set("beta", beta);
    const auto intervals = unstable_intervals(o, 0.);
    ASSERT_EQ(intervals.size(), 1u);
    EXPECT_NEAR(intervals[0].from, 1. / std::sqrt(0.25 - beta), 1e-9);
    EXPECT_TRUE(std::isinf(intervals[0].to));
  }
  // gamma < 1/2: 2 zeta Omega = (1/2 - gamma) Omega^2, and from zero on without damping.
  o.set("beta", 0.25);
  o.set("gamma", 0.45);
  EXPECT_NEAR(unstable_intervals(o, 0.01).at(0).from, 0.02 / 0.05, 1e-9);
  EXPECT_EQ(unstable_intervals(o, 0.).at(0).from, 0.);
}

TEST(Stability, ExactPropagationNeverMakesTheBaseGrow)
{
  MethodOptions o;
  o.method = "exact";
  for (const double zeta : {0., 0.02, 1., 3.})
    for (const double omega_h : {1e-3, 1., 3.14159, 1e3})
    {
      const auto step = step_properties(o, {zeta, omega_h});
      EXPECT_LE(step.spectral_radius, 1.);
      const Eigen::VectorXcd roots = method_of(o).amplification_matrix(o, {zeta, omega_h}).eigenvalues();
      // 2 x 2 with entries up to omega_h: two near roots are known to sqrt(1e-16 omega_h).
      EXPECT_NEAR(roots.cwiseAbs().maxCoeff(), step.spectral_radius, 1e-6) << zeta << ' ' << omega_h;
    }
  EXPECT_TRUE(unstable_intervals(o, 0.).empty());
}

TEST(Stability, ContactsUnderExactPropagation)
{
  MethodOptions o;
  o.method = "exact";
  o.set("force", "average");
  EXPECT_TRUE(unstable_intervals(o, 0., Spring::contact).empty());
  EXPECT_TRUE(unstable_intervals(o, 0.05, Spring::contact).empty());

  o.set("force", "linear");
  auto linear = unstable_intervals(o, 0., Spring::contact);
  ASSERT_EQ(linear.size(), 1u);
  EXPECT_NEAR(linear[0].from, 2. * std::sqrt(3.), 1e-9);

  // One Gauss point: |1 - Omega^2/2 / (1 + Omega^2/8)| = 1 at Omega^2 = 8, and never again.
  o.set("force", "collocation");
  o.order  = 2;
  auto one = unstable_intervals(o, 0., Spring::contact);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].from, std::sqrt(8.), 1e-9);
  // Two points: trace = +-2 at 3, 2 sqrt(3) and 6.  Between 2 sqrt(3) and 6 the contact stands again.
  o.order  = 4;
  auto two = unstable_intervals(o, 0., Spring::contact);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[0].from, 3., 1e-9);
  EXPECT_NEAR(two[0].to, 2. * std::sqrt(3.), 1e-9);
  EXPECT_NEAR(two[1].from, 6., 1e-9);
  for (const int order : {2, 4, 6, 8})
  {
    o.order = order;
    for (const auto &interval : unstable_intervals(o, 0., Spring::contact))
    {
      const double inside = std::isinf(interval.to) ? 2. * interval.from : 0.5 * (interval.from + interval.to);
      EXPECT_GT(spectral_radius(o, {0., inside, Spring::contact}), 1.) << order;
      EXPECT_NEAR(spectral_radius(o, {0., interval.from * (1. - 1e-6), Spring::contact}), 1., 1e-12) << order;
    }
  }
}

TEST(Stability, NoIslandOfGrowthIsMissed)
{
  MethodOptions o;
  o.method = "exact";
  o.set("force", "collocation");
  for (const double zeta : {0., 1e-4, 0.02})
    for (const int order : {2, 4, 6, 8})
    {
      o.order              = order;
      const auto intervals = unstable_intervals(o, zeta, Spring::contact);
      for (double omega_h = 0.5; omega_h < 20.; omega_h += 0.0037)
      {
        bool within = false;
        for (const auto &interval : intervals)
          within = within || (omega_h > interval.from && omega_h < interval.to);
        EXPECT_EQ(step_properties(o, {zeta, omega_h, Spring::contact}).log_growth > 1e-12, within)
            << order << ' ' << zeta << ' ' << omega_h;
      }
    }
}

TEST(Stability, ContactCollocationHasTheOrderOfItsPoints)
{
  MethodOptions o;
  o.method = "exact";
  o.set("force", "collocation");
  for (const int order : {2, 4, 6, 8})
  {
    o.order           = order;
    const auto period = [&](double omega_h) {
      return std::abs(step_properties(o, {0., omega_h, Spring::contact}).period_elongation);
    };
    EXPECT_NEAR(std::log2(period(0.5) / period(0.25)), order, 0.1) << order;
  }
}

TEST(Stability, RootsOfPolynomialsIncludeZeroesAndWideScales)
{
  // (x - 1e-6)(x + 3)(x - 2e5 i) and a root at zero
  const LongComplex        a = 1e-6L, b = -3.L, c(0.L, 2e5L);
  std::vector<LongComplex> roots =
      polynomial_roots({0.L, -a * b * c, a * b + a * c + b * c, -(a + b + c), 1.L, 0.L, 0.L});
  ASSERT_EQ(roots.size(), 4u);
  for (const LongComplex &wanted : {LongComplex(0.L), a, b, c})
  {
    long double nearest = 1e9L;
    for (const LongComplex &root : roots)
      nearest = std::min(nearest, std::abs(root - wanted));
    EXPECT_LE(static_cast<double>(nearest), 1e-15 * static_cast<double>(std::abs(wanted)));
  }
}

TEST(Stability, RefusesWhatIsNoOscillator)
{
  EXPECT_THROW(step_properties({}, {0., 0.}), std::invalid_argument);
  EXPECT_THROW(step_properties({}, {-0.1, 1.}), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
