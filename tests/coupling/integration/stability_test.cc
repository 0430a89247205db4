// The test oscillator under every method: tables of spectral radius, unstable intervals, period and damping, overshoot
// (tests/reference/numerics/stability, computed with 30 to 40 digits), and theorems about them.

#include "coupling/integration/bdf/bdf_method.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/stability/overshoot.h"
#include "coupling/integration/stability/polynomial_roots.h"
#include "coupling/integration/stability/stability.h"
#include "tests/support/methods.h"
#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"
#include "tests/support/step_map.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell::tests
{
namespace
{

using namespace coupling;

/// Every method that is there, for properties that all have.
std::vector<MethodOptions> all_families()
{
  std::vector<MethodOptions> methods;
  std::set<std::string>      seen;
  for (const auto &row : read_reference("stability/spectral_radius.csv"))
    if (const auto o = named_method(row["method"]); o && seen.insert(row["method"]).second)
      methods.push_back(*o);
  return methods;
}

TEST(Stability, SpectralRadiusAgreesWithTheTable)
{
  int rows = 0;
  for (const auto &row : read_reference("stability/spectral_radius.csv"))
    if (const auto o = named_method(row["method"]))
    {
      const TestOscillator oscillator{row.number("zeta"), row.number("omega_h")};
      // 13 digits are given; simple roots are known to long double, two that meet to sqrt(1e-19).
      const double wanted = row.number("spectral_radius");
      EXPECT_NEAR(spectral_radius(*o, oscillator), wanted, 1e-9 * std::max(1., wanted))
          << row["method"] << ' ' << oscillator.zeta << ' ' << oscillator.omega_h;
      ++rows;
    }
  EXPECT_EQ(rows, 26 * 100);
}

TEST(Stability, RadiusAtInfinityAndLimitOfWilson)
{
  for (const auto &row : read_reference("stability/limits.csv"))
  {
    const std::string &quantity = row["quantity"];
    if (quantity.rfind("rho_inf(", 0) == 0)
    {
      std::string name = quantity.substr(8, quantity.size() - 9);
      if (name == "newmark_g0.6_b0.3025" || name.rfind("hht", 0) == 0 || name.rfind("galpha", 0) == 0)
      {
        // Three roots meet at infinity: at omega h = 1e8 they lie (1e8)^(-2/3) = 5e-6 away from there.
        EXPECT_NEAR(spectral_radius(*named_method(name), {0., 1e8}), row.number("value"), 1e-5) << name;
      }
    }
    if (quantity.rfind("wilson_rho_inf_theta_", 0) == 0)
    {
      EXPECT_NEAR(spectral_radius(*named_method("wilson_theta_" + quantity.substr(21)), {0., 1e8}), row.number("value"),
                  1e-9);
    }
  }
  for (int order = 1; order <= 6; ++order) // r^p omega_h -> const: zero as omega h grows
    EXPECT_LT(spectral_radius(bdf(order, 0.), {0., 1e12}), 2e-2);
}

TEST(Stability, UnstableIntervalsAgreeWithTheTable)
{
  std::map<std::string, std::vector<ReferenceRow>> cases;
  for (const auto &row : read_reference("stability/unstable_intervals.csv"))
    cases[row["method"] + " " + row["zeta"]].push_back(row);
  for (const auto &[name, rows] : cases)
  {
    const auto o = named_method(rows[0]["method"]);
    if (!o)
      continue;
    const auto intervals = unstable_intervals(*o, rows[0].number("zeta"));
    if (rows[0]["unstable_from_omega_h"] == "none")
    {
      EXPECT_TRUE(intervals.empty()) << name << " from " << intervals[0].from;
      continue;
    }
    ASSERT_EQ(intervals.size(), rows.size()) << name;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      // The table's own ends were found by bisection in 1e-14 of growth: 1e-12 relative where growth is steep.
      const double from = rows[i].number("unstable_from_omega_h");
      EXPECT_NEAR(intervals[i].from, from, 1e-9 * (1. + from)) << name;
      if (rows[i]["unstable_to_omega_h"] == "inf")
        EXPECT_TRUE(std::isinf(intervals[i].to)) << name;
      else
      {
        const double to = rows[i].number("unstable_to_omega_h"), growth = rows[i].number("max_growth_per_step");
        EXPECT_NEAR(intervals[i].to, to, 1e-9 * to) << name;
        // The table's largest growth is that of a grid of omega h, a little below the peak.
        EXPECT_GE(intervals[i].growth, growth - 1e-8) << name;
        EXPECT_NEAR(intervals[i].growth, growth, 1e-5) << name;
        EXPECT_NEAR(intervals[i].at_omega_h, rows[i].number("at_omega_h"), 0.02) << name;
      }
    }
  }
}

TEST(Stability, PeriodAndDampingAgreeWithTheTable)
{
  for (const auto &row : read_reference("stability/dispersion_dissipation.csv"))
    if (const auto o = named_method(row["method"]))
    {
      const auto        properties = step_properties(*o, {row.number("zeta"), row.number("omega_h")});
      const std::string where      = row["method"] + " " + row["zeta"] + " " + row["omega_h"];
      if (row["period_elongation_rel"] == "overdamped")
      {
        EXPECT_TRUE(std::isnan(properties.period_elongation)) << where;
        continue;
      }
      // 12 digits are given; ln r and zeta come with 1e-19, which is what counts where nearly nothing is left.
      const double period = row.number("period_elongation_rel"), damping = row.number("numerical_damping_ratio_extra");
      EXPECT_NEAR(properties.period_elongation, period, 1e-11 * std::abs(period) + 1e-17) << where;
      EXPECT_NEAR(properties.numerical_damping, damping, 1e-11 * std::abs(damping) + 1e-17) << where;
    }
}

TEST(Stability, OvershootAgreesWithTheTable)
{
  for (const auto &row : read_reference("stability/overshoot.csv"))
    if (const auto o = named_method(row["method"]))
    {
      const auto start  = row["start"] == "x0=1,v0=0" ? OscillatorStart::displaced : OscillatorStart::moving;
      const auto result = overshoot(*o, {0., row.number("omega_h")}, start, FirstSteps::order_ramp);
      // 11 digits; 20 steps of a state whose parts differ by omega_h^2 = 1e6 lose as many.
      const double x          = row.number("max_abs_x_first_20_steps_rel"),
                   v          = row.number("max_abs_v_over_w_first_20_steps_rel");
      const std::string where = row["method"] + " " + row["omega_h"] + " " + row["start"];
      EXPECT_NEAR(result.displacement, x, 1e-9 * std::max(1., x)) << where;
      EXPECT_NEAR(result.velocity, v, 1e-9 * std::max(1., v)) << where;
    }
}

TEST(Stability, OvershootOfBdfIsThatOfTheIntegratorItself)
{
  for (int order = 2; order <= 6; ++order)
    for (const double omega : {0.5, 2., 5.})
      for (const auto start : {OscillatorStart::displaced, OscillatorStart::moving})
      {
        const SmallSystem   system(Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1),
                                   Eigen::MatrixXd::Constant(1, 1, omega * omega));
        const MethodOptions method     = bdf(order, 1.);
        const auto          integrator = make_integrator(system, method);
        const bool          displaced  = start == OscillatorStart::displaced;
        integrator->begin(0., Eigen::VectorXd::Constant(1, displaced ? 1. : 0.),
                          Eigen::VectorXd::Constant(1, displaced ? 0. : omega));
        double x = displaced ? 1. : 0., v = 1. - x;
        for (int step = 0; step < 20; ++step)
        {
          integrator->advance();
          x = std::max(x, std::abs(integrator->instant().q[0]));
          v = std::max(v, std::abs(integrator->instant().v[0]) / omega);
        }
        const Overshoot reported = overshoot(method, {0., omega}, start);
        EXPECT_NEAR(reported.displacement, x, 1e-10 * x) << "BDF " << order << " at " << omega;
        EXPECT_NEAR(reported.velocity, v, 1e-10 * v) << "BDF " << order << " at " << omega;
      }
}

TEST(Stability, SufficientDampingOfBdfAgreesWithTheTable)
{
  for (const auto &row : read_reference("stability/bdf_sufficient_damping.csv"))
  {
    MethodOptions o;
    o.order            = bdf_order(row["method"]);
    const double ratio = row.number("sufficient_damping_ratio");
    EXPECT_TRUE(unstable_intervals(o, ratio * (1. + 1e-9)).empty()) << row["method"];
    if (ratio > 0.) // just below, a narrow interval about the critical omega h must not be stepped over
    {
      const auto intervals = unstable_intervals(o, ratio * (1. - 1e-9));
      ASSERT_EQ(intervals.size(), 1u) << row["method"];
      EXPECT_LT(intervals[0].from, row.number("critical_omega_h"));
      EXPECT_GT(intervals[0].to, row.number("critical_omega_h"));
      EXPECT_LT(intervals[0].to - intervals[0].from, 1e-2);
    }
  }
}

TEST(Stability, MatrixAndCharacteristicRootsAreTheSameStep)
{
  for (const MethodOptions &o : all_families())
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
  MethodOptions o = method("newmark", 0., 2, {{"gamma", 0.5}});
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
  const MethodOptions o = method("exact", 0.);
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
  MethodOptions o = method("exact", 0., 2, {{"force", "average"}});
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

// Both roots of a motion that hardly turns in a step are one: rounding of trace and determinant parts them by its root.
TEST(Stability, AContactThatHardlyTurnsInAStepDoesNotGrowByRounding)
{
  MethodOptions o = method("exact", 0., 2, {{"force", "collocation"}});
  for (const int order : {2, 4, 6, 8})
    for (double omega_h = 1e-13; omega_h < 1e-3; omega_h *= 1.37)
      for (const double zeta : {0., 5.22e-6, 0.3})
      {
        o.order = order;
        EXPECT_LE(step_properties(o, {zeta, omega_h, Spring::contact}).log_growth, 1e-15)
            << order << ' ' << omega_h << ' ' << zeta;
      }
}

TEST(Stability, NoIslandOfGrowthIsMissed)
{
  MethodOptions o = method("exact", 0., 2, {{"force", "collocation"}});
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
  MethodOptions o = method("exact", 0., 2, {{"force", "collocation"}});
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

TEST(Stability, RefusesWhatIsNotAnOscillator)
{
  EXPECT_THROW(step_properties({}, {0., 0.}), std::invalid_argument);
  EXPECT_THROW(step_properties({}, {-0.1, 1.}), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
