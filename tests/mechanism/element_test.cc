// What holds for every force element.

#include "mechanism/elements/blanking_force.h"
#include "mechanism/elements/clearance.h"
#include "mechanism/elements/common_tangents.h"
#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/cubic_spring.h"
#include "mechanism/elements/cutting_force.h"
#include "mechanism/elements/drawing_force.h"
#include "mechanism/elements/dynamic_motor.h"
#include "mechanism/elements/gas_force.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/kloss_motor.h"
#include "mechanism/elements/lugre_friction.h"
#include "mechanism/elements/point_contact.h"
#include "mechanism/elements/regularised_friction.h"
#include "mechanism/elements/rolling_bearing.h"
#include "mechanism/elements/rope.h"
#include "mechanism/elements/speed_drive.h"
#include "mechanism/elements/table_force.h"
#include "mechanism/elements/unbalance.h"
#include "tests/support/element_probe.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const ConnectingRod::Parameters stiff_rod{0.08, 0.8, 9e8, 1.8e5, 1e-4, 4e-4, 5e4};
const BlankingForce::Parameters sheet{0.004, 0.8, 3.2e8, 0.35, 8., 0.25, 0.08, 9e9, 0.};

/// An element, a motion inside one of its branches, and typical sizes of u and u' there.
struct Case
{
  std::string               name;
  std::shared_ptr<ForceLaw> element;
  Probe                     probe;
  double                    du = 1e-7, dv = 1e-4;
};

Probe rod_probe(double delta, double rate)
{
  const double phi = 2.5, y = 2e-4;
  const double c = stiff_rod.crank_radius * std::sin(phi) + y,
               w = std::sqrt(stiff_rod.length * stiff_rod.length - c * c);
  const double u = -stiff_rod.crank_radius * std::cos(phi) + w - (stiff_rod.length - stiff_rod.crank_radius);
  return {0., Eigen::Vector3d(phi, delta - u, y), Eigen::Vector3d(3., rate, 0.02), Eigen::Vector3d::Zero()};
}

/// History of a motion that came to the probe from 10 um before it: kinks at the start of a motion lie behind.
Eigen::VectorXd arrived(const Case &c)
{
  Probe earlier = c.probe;
  earlier.u.array() -= 1e-5;
  return started(*c.element, earlier);
}

Probe probe3(const Eigen::Vector3d &u, const Eigen::Vector3d &v)
{
  return {0.3, u, v, Eigen::Vector3d::Zero()};
}

const SlidingFriction rubbing_pin{0.1, 2e-3, 0.2, 0.05, 1.};

std::vector<Case> cases()
{
  const auto journal = [](double exponent)
  {
    return std::make_shared<JournalBearing>(
        JournalBearing::Parameters{5e-4, 0.03, exponent == 1. ? 1e9 : 1e11, 4., exponent, rubbing_pin});
  };
  const auto contact = [](Clearance::Stops stops) {
    return std::make_shared<PointContact>(PointContact::Parameters{{5e-5, 1e9, 4., stops}, rubbing_pin});
  };
  const auto connecting_rod = std::make_shared<ConnectingRod>(stiff_rod);
  const auto blanking       = std::make_shared<BlankingForce>(sheet);
  const auto clearance      = std::make_shared<Clearance>(Clearance::Parameters{5e-5, 1e9, 4.});
  const auto cutting        = std::make_shared<CuttingForce>(CuttingForce::Parameters{5e3, 6e-4, 4e-4, 0.02});
  const auto coulomb        = std::make_shared<CoulombFriction>(CoulombFriction::Parameters{300., 350., 0.});
  const auto stop           = [](Clearance::Stops stops) {
    return std::make_shared<Clearance>(Clearance::Parameters{5e-5, 1e9, 4., stops});
  };
  const auto table = [](TableForce::Against against)
  {
    return std::make_shared<TableForce>(
        TableForce::Parameters{against, {{0., 0.}, {0.2, -50.}, {0.2, 100.}, {0.5, 40.}}});
  };
  return {
      {"rod_compressed", connecting_rod, rod_probe(3e-4, 0.1)},
      {"journal_in_play", journal(1.), probe3({3e-4, -2e-4, 1.}, {0.1, 0.2, 3.})},
      {"journal_pressed", journal(1.), probe3({4.2e-4, -3.2e-4, 1.}, {0.02, 0.01, 0.3})},
      {"journal_creeping", journal(1.), probe3({-2e-4, -4.9e-4, 0.}, {0., 0., 0.01}), 1e-7, 1e-6},
      {"journal_after_hertz", journal(1.5), probe3({-4.2e-4, 3.2e-4, 1.}, {0.05, -0.02, -2.})},
      {"journal_slack", journal(1.), probe3({4.2e-4, 3.2e-4, 0.}, {-0.4, -0.3, 1.})},
      {"point_above_plane", contact(Clearance::Stops::below), probe3({1e-5, 2., -3.}, {-0.1, 0.2, 0.3})},
      {"point_in_plane", contact(Clearance::Stops::below), probe3({-7e-5, 2., -3.}, {-0.1, 2e-3, -3e-3}), 1e-7, 1e-6},
      {"point_at_rest", contact(Clearance::Stops::below), probe3({-7e-5, 2., -3.}, {0., 0., 0.}), 1e-7, 1e-7},
      {"point_between_planes", contact(Clearance::Stops::both), probe3({8e-5, 2., -3.}, {0.1, 0.2, 0.3})},
      {"rod_in_gap", connecting_rod, rod_probe(-2e-4, -0.1)},
      {"rod_pulled", connecting_rod, rod_probe(-7e-4, 0.2)},
      {"sheet_rising", blanking, probe1(4e-4, 0.1)},
      {"sheet_breaking", blanking, probe1(1.9e-3, 0.1)},
      {"slug", blanking, probe1(3.1e-3, 0.1)},
      {"clearance_open", clearance, probe1(2e-5, 0.1)},
      {"clearance_positive", clearance, probe1(7e-5, 0.1)},
      {"clearance_negative", clearance, probe1(-7e-5, 0.1)},
      {"stop_above", stop(Clearance::Stops::above), probe1(7e-5, 0.1)},
      {"stop_above_open", stop(Clearance::Stops::above), probe1(-7e-5, 0.1)},
      {"stop_below", stop(Clearance::Stops::below), probe1(-7e-5, 0.1)},
      {"stop_below_open", stop(Clearance::Stops::below), probe1(7e-5, 0.1)},
      {"table_time", table(TableForce::Against::time), probe1(0., 0.1)},
      {"table_displacement", table(TableForce::Against::displacement), probe1(0.35, 0.1)},
      {"table_rate", table(TableForce::Against::rate), probe1(0., 0.35)},
      {"cutting", cutting, probe1(9e-4, 0.01)},
      {"cubic_spring", std::make_shared<CubicSpring>(CubicSpring::Parameters{1e6, 5e12}), probe1(3e-4, 0.)},
      {"friction", std::make_shared<RegularisedFriction>(RegularisedFriction::Parameters{300., 2e-3}), probe1(0., 1e-3),
       1e-7, 1e-7},
      {"dry_forward", coulomb, probe1(0., 0.3)},
      {"dry_backward", coulomb, probe1(0., -0.2)},
      {"stribeck", std::make_shared<CoulombFriction>(CoulombFriction::Parameters{300., 350., 0., 0.2, 1., 40.}),
       probe1(0., 0.3)},
      {"stribeck_squared_backward",
       std::make_shared<CoulombFriction>(CoulombFriction::Parameters{300., 350., 0., 0.2, 2., 40.}), probe1(0., -0.3)},
      {"smooth_stribeck",
       std::make_shared<RegularisedFriction>(RegularisedFriction::Parameters{300., 2e-3, 350., 3e-3, 1., 40.}),
       probe1(0., -1e-3), 1e-7, 1e-7},
      {"lugre",
       std::make_shared<LuGreFriction>(LuGreFriction::Parameters{300., 350., 0.2, 1., 1e6, 40., 5.}),
       {0., Eigen::Vector2d(0., -200.), Eigen::Vector2d(-0.1, 0.), Eigen::Vector2d::Zero()}},
      {"ball_positive", std::make_shared<Clearance>(Clearance::Parameters{5e-5, 1e11, 4., Clearance::Stops::both, 1.5}),
       probe1(9e-5, 0.1)},
      {"ball_negative", std::make_shared<Clearance>(Clearance::Parameters{5e-5, 1e11, 4., Clearance::Stops::both, 1.5}),
       probe1(-9e-5, 0.1)},
      {"rope_taut", std::make_shared<Rope>(Rope::Parameters{1e4, 50., 2e-3}), probe1(3e-3, -0.1)},
      {"rope_slack", std::make_shared<Rope>(Rope::Parameters{1e4, 50., 2e-3}), probe1(1e-3, 0.1)},
      {"belt_taut", std::make_shared<Belt>(Belt::Parameters{8e4, 50., 5e-3, -0.09, 0.5}),
       probe3({1e-3, -1e-3, 1e-5}, {0.1, -0.2, 0.3})},
      {"belt_slack", std::make_shared<Belt>(Belt::Parameters{8e4, 50., 5e-3, -0.09, 0.5}),
       probe3({6e-3, -6e-3, 1e-5}, {0.1, -0.2, 0.3})},
      {"rolling",
       std::make_shared<RollingBearing>(
           RollingBearing::Parameters{{{5e-6, 0.}, {1e-5, 800.}, {2e-5, 4500.}}, 2e3, 1e8}),
       probe3({8e-6, -9e-6, 1e-5}, {0.1, -0.1, 0.3}), 1e-9},
      {"rolling_beyond", std::make_shared<RollingBearing>(RollingBearing::Parameters{{{1e-5, 800.}}, 2e3, 1e8}),
       probe3({8e-6, -9e-6, 1e-5}, {0.1, -0.1, 0.3}), 1e-9},
      {"teeth", std::make_shared<GearPair>(GearPair::Parameters{5e6, 500., -1e-4, 0.47, 0.5}, 0.2),
       probe3({-3e-4, 3e-4, 1e-5}, {0.1, -0.1, 0.3})},
      {"gas", std::make_shared<GasForce>(GasForce::Parameters{1e-2, 5e-5, 0., 1.3, 2e5, 1e5, false, {}}),
       probe1(-0.05, 0.1)},
      {"drawing_elastic", std::make_shared<DrawingForce>(DrawingForce::Parameters{1e4, 1e8, 0., 3e-3}),
       probe1(5e-5, 0.1)},
      {"drawing_flow", std::make_shared<DrawingForce>(DrawingForce::Parameters{1e4, 1e8, 0., 3e-3}), probe1(2e-4, 0.1)},
      {"speed_drive",
       std::make_shared<SpeedDrive>(SpeedDrive::Parameters{40., 300., 900., Profile(30.)}),
       {0., Eigen::Vector2d(0.1, 12.), Eigen::Vector2d(28., 3.), Eigen::Vector2d::Zero()}},
      {"dynamic_motor",
       std::make_shared<DynamicMotor>(KlossMotor::Parameters{240., 0.15, 157., 49.}),
       {0., Eigen::Vector2d(0.1, 900.), Eigen::Vector2d(3.1, 3.), Eigen::Vector2d::Zero()}},
      {"unbalance",
       std::make_shared<Unbalance>(Unbalance::Parameters{0.02, 0.3, {9.81, -1.}}),
       {0., Eigen::Vector3d(2., 1e-3, -2e-3), Eigen::Vector3d(60., 0.3, -0.2), Eigen::Vector3d(-40., 20., 30.)}},
      {"motor", std::make_shared<KlossMotor>(KlossMotor::Parameters{240., 0.15, 157., 49.}), probe1(0., 3.1)}};
}

std::ostream &operator<<(std::ostream &out, const Case &c)
{
  return out << c.name;
}

using Element = ::testing::TestWithParam<Case>;

// Central quotients err by O(d^2) of the third derivative and by rounding eps |p| / d: 1e-5 covers both for the chosen
// d.
TEST_P(Element, TangentFromDualNumbersEqualsCentralQuotients)
{
  const Case           &c       = GetParam();
  const int             k       = c.element->n_measures();
  const Eigen::VectorXd history = arrived(c);
  for (const TangentWeights w : {TangentWeights{1., 0., 0.}, TangentWeights{0., 1., 0.}, TangentWeights{1., 150., 2e4}})
  {
    Eigen::VectorXd p(k);
    Eigen::MatrixXd dp(k, k);
    c.element->tangent(c.probe.motion(), history.data(), w, p.data(), dp.data());
    EXPECT_LE((p - force(*c.element, c.probe, history.data())).norm(), 1e-14 * p.norm()); // rounding
    for (int j = 0; j < k; ++j)
    {
      const double d    = w.u == 0. ? c.dv : std::min(c.du, w.v > 0. ? c.dv / w.v : c.du);
      Probe        plus = c.probe, minus = c.probe;
      plus.u[j] += w.u * d, plus.v[j] += w.v * d, plus.a[j] += w.a * d;
      minus.u[j] -= w.u * d, minus.v[j] -= w.v * d, minus.a[j] -= w.a * d;
      const Eigen::VectorXd quotient =
          (force(*c.element, plus, history.data()) - force(*c.element, minus, history.data())) / (2. * d);
      const double scale = dp.norm() + 1e-8 * p.norm() / d + 1e-300;
      EXPECT_LT((dp.col(j) - quotient).norm(), 1e-5 * scale) << c.name << ", measure " << j;
    }
  }
}

// The same rules of differentiation in the same order: what differs is the sum over u and v, in rounding.
TEST_P(Element, DerivativesSumUpToEveryTangent)
{
  const Case           &c       = GetParam();
  const int             k       = c.element->n_measures();
  const Eigen::VectorXd history = arrived(c);
  Eigen::VectorXd       p(k), p_tangent(k);
  Eigen::MatrixXd       dp_du(k, k), dp_dv(k, k), tangent(k, k);
  c.element->derivatives(c.probe.motion(), history.data(), p.data(), dp_du.data(), dp_dv.data());
  EXPECT_LE((p - force(*c.element, c.probe, history.data())).norm(), 1e-14 * p.norm());
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> weight(-1e3, 1e3);
  for (int trial = 0; trial < 20; ++trial)
  {
    const TangentWeights w{weight(random), weight(random), 0.};
    c.element->tangent(c.probe.motion(), history.data(), w, p_tangent.data(), tangent.data());
    const double scale = std::abs(w.u) * dp_du.norm() + std::abs(w.v) * dp_dv.norm();
    EXPECT_LE((tangent - w.u * dp_du - w.v * dp_dv).norm(), 1e-13 * scale) << c.name;
    EXPECT_LE((p - p_tangent).norm(), 1e-14 * p.norm());
  }
  // The default of the interface, two tangents, is the same thing.
  Eigen::MatrixXd by_u(k, k), by_v(k, k);
  c.element->ForceLaw::derivatives(c.probe.motion(), history.data(), p.data(), by_u.data(), by_v.data());
  EXPECT_LE((by_u - dp_du).norm(), 1e-14 * dp_du.norm());
  EXPECT_LE((by_v - dp_dv).norm(), 1e-14 * dp_dv.norm());
}

// What is left of power and growth is dissipated: never less than rounding, whatever the step of an integrator.
TEST_P(Element, StoredPowerIsTheGrowthOfTheStoredEnergy)
{
  const Case &c = GetParam();
  if (std::dynamic_pointer_cast<LuGreFriction>(c.element)) // the bristles move as their law says
    return;
  const Eigen::VectorXd history = arrived(c);
  const double          dt      = 1e-9;
  const Probe           before = c.probe.moved(-0.5 * dt), after = c.probe.moved(0.5 * dt);
  const double          growth = (c.element->stored_energy(after.motion(), history.data()) -
                         c.element->stored_energy(before.motion(), history.data())) /
                        dt;
  const double stored = c.element->stored_power(c.probe.motion(), history.data());
  const double power  = force(*c.element, c.probe, history.data()).dot(c.probe.v);
  EXPECT_NEAR(stored, growth, 1e-5 * (std::abs(power) + std::abs(stored))); // rounding of the energy, eps E/dt
  if (c.element->work() == Work::dissipated)
  {
    EXPECT_LE(power + stored, 1e-14 * (std::abs(power) + std::abs(stored)));
  }
}

TEST(LuGreFriction, StoresWhatItsBristlesTake)
{
  const LuGreFriction   friction({300., 350., 0.2, 1., 1e6, 40., 5.});
  const Probe           probe{0., Eigen::Vector2d(0., -200.), Eigen::Vector2d(-0.1, 0.), Eigen::Vector2d::Zero()};
  const Eigen::VectorXd history = started(friction, probe);
  const double          rate    = -0.1 + 0.1 * 200. / (300. + 50. * std::exp(-0.5)); // z' = v - |v| F/R
  EXPECT_NEAR(friction.stored_power(probe.motion(), history.data()), -200. * rate, 1e-9);
}

TEST_P(Element, GuardsAreOpenWhereTheMotionStarts)
{
  const Case     &c        = GetParam();
  Eigen::VectorXd history  = arrived(c);
  const Branches *branches = c.element->branches();
  if (!branches)
    return;
  const auto guards = branches->guards(history.data());
  ASSERT_EQ(static_cast<int>(guards.size()), branches->n_guards(history.data()));
  Eigen::VectorXd g = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(guards.size()) + 1);
  branches->guard_values(c.probe.motion(), history.data(), g.data());
  for (std::size_t i = 0; i < guards.size(); ++i)
    EXPECT_LT((guards[i].crossing == Crossing::rising ? 1. : -1.) * g[static_cast<Eigen::Index>(i)], 0.)
        << c.name << ": " << guards[i].kind;
}

INSTANTIATE_TEST_SUITE_P(All, Element, ::testing::ValuesIn(cases()),
                         [](const auto &information) { return information.param.name; });

TEST(CubicSpring, LosesNoEnergy)
{
  const CubicSpring spring({1e6, 5e12});
  const double      u0 = -3e-4, u1 = 5e-4;
  double            work = 0.;
  const int         n    = 20000; // trapezoidal rule: error (u1-u0)^2/(12 n^2) |p''| of the work, < 1e-8 relative
  for (int i = 0; i <= n; ++i)
    work +=
        (i == 0 || i == n ? 0.5 : 1.) * (u1 - u0) / n * force(spring, probe1(u0 + (u1 - u0) * i / n, 0.), nullptr)[0];
  const double change =
      spring.stored_energy(probe1(u1, 0.).motion(), nullptr) - spring.stored_energy(probe1(u0, 0.).motion(), nullptr);
  EXPECT_NEAR(-work, change, 1e-8 * std::abs(change));
}

TEST(KlossMotor, HasItsBreakdownTorqueAtItsBreakdownSlip)
{
  const KlossMotor motor({240., 0.15, 157., 49.});
  const double     shaft_speed = (1. - 0.15) * 157. / 49.;
  EXPECT_NEAR(force(motor, probe1(0., shaft_speed), nullptr)[0], 49. * 240., 1e-8);
  EXPECT_NEAR(force(motor, probe1(0., 157. / 49.), nullptr)[0], 0., 1e-8);
}

TEST(Clearance, IsContinuousAtTouchDownAndNeverPulls)
{
  const Clearance clearance({5e-5, 1e9, 4.});
  const double    history = 1.;
  EXPECT_NEAR(force(clearance, probe1(5e-5 + 1e-12, 0.5), &history)[0], 0., 1e-2);
  EXPECT_EQ(force(clearance, probe1(6e-5, -0.26), &history)[0], 0.); // 1 + 4 v < 0
  EXPECT_LT(force(clearance, probe1(6e-5, 0.1), &history)[0], 0.);
  EXPECT_GT(force(clearance, probe1(-6e-5, -0.1), &history)[0], 0.);
}

TEST(CuttingForce, PeaksAtItsPeakPenetrationAndReleasesOutwards)
{
  const CuttingForce cutting({5e3, 6e-4, 4e-4, 0.02});
  EXPECT_NEAR(force(cutting, probe1(1e-3, 1.), nullptr)[0], -5e3, 1e-6);
  EXPECT_NEAR(force(cutting, probe1(1e-3, -1.), nullptr)[0], 0., 1e-6);
  EXPECT_EQ(force(cutting, probe1(3e-4, 1.), nullptr)[0], 0.);
}

TEST(Parameters, OutOfRangeAreRefusedByName)
{
  expect_refusal([] { Clearance({-1e-5, 1e9, 0.}); }, "gap");
  expect_refusal([] { Clearance({1e-5, 0., 0.}); }, "stiffness");
  expect_refusal([] { Clearance({1e-5, 1e9, -1.}); }, "dissipation");
  expect_refusal([] { KlossMotor({0., 0.15, 157., 49.}); }, "breakdown_torque");
  expect_refusal([] { KlossMotor({240., 0., 157., 49.}); }, "breakdown_slip");
  expect_refusal([] { KlossMotor({240., 0.15, 0., 49.}); }, "synchronous_speed");
  expect_refusal([] { KlossMotor({240., 0.15, 157., 0.}); }, "ratio");
  expect_refusal([] { RegularisedFriction({-1., 1e-3}); }, "force");
  expect_refusal([] { RegularisedFriction({1., 0.}); }, "speed");
  expect_refusal([] { CubicSpring({std::nan(""), 0.}); }, "stiffness");
  expect_refusal([] { CuttingForce({-1., 1e-3, 0., 0.01}); }, "peak_force");
  expect_refusal([] { CuttingForce({1., 0., 0., 0.01}); }, "peak_penetration");
  expect_refusal([] { CuttingForce({1., 1e-3, 0., 0.}); }, "speed");
}

} // namespace
} // namespace gestell::tests
