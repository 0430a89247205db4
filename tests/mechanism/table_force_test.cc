#include "mechanism/elements/rolling_bearing.h"
#include "mechanism/elements/table_force.h"
#include "tests/support/element_probe.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;
using Against = TableForce::Against;

/// Rises to 0.2, jumps, falls to 0.5, constant beyond.
TableForce table(Against against)
{
  return TableForce({against, {{0., 10.}, {0.2, 50.}, {0.2, -20.}, {0.5, -50.}}});
}

double expected(double x)
{
  return x < 0. ? 10. : x < 0.2 ? 10. + 200. * x : x < 0.5 ? -20. - 100. * (x - 0.2) : -50.;
}

/// A motion whose abscissa is x.
Probe at(Against against, double x)
{
  Probe probe = probe1(against == Against::displacement ? x : 7., against == Against::rate ? x : 8.);
  probe.t     = against == Against::time ? x : 9.;
  return probe;
}

using Tables = ::testing::TestWithParam<Against>;

TEST_P(Tables, AreLinearBetweenTheirRowsAndConstantBeyond)
{
  const TableForce element = table(GetParam());
  for (const double x : {-3., -0.01, 0., 0.13, 0.1999, 0.2, 0.35, 0.5, 4.})
  {
    const Probe           probe   = at(GetParam(), x);
    const Eigen::VectorXd history = started(element, probe);
    EXPECT_NEAR(force(element, probe, history.data())[0], expected(x), 1e-12) << x;
    EXPECT_EQ(force(element, probe, history.data(), true), force(element, probe, history.data())) << x;
    EXPECT_EQ(element.quantity(0, probe.motion(), history.data()), force(element, probe, history.data())[0]);
  }
}

TEST_P(Tables, HaveExactTangentsAlsoBeyondTheirCorners)
{
  const TableForce      element = table(GetParam());
  const Eigen::VectorXd history = started(element, at(GetParam(), 0.1));
  double                p, of_u, of_v;
  element.derivatives(at(GetParam(), 0.3).motion(true), history.data(), &p, &of_u, &of_v);
  EXPECT_NEAR(p, 10. + 200. * 0.3, 1e-12); // the segment of the history goes on
  EXPECT_EQ(of_u, GetParam() == Against::displacement ? 200. : 0.);
  EXPECT_EQ(of_v, GetParam() == Against::rate ? 200. : 0.);
  element.derivatives(at(GetParam(), 0.3).motion(false), history.data(), &p, &of_u, &of_v);
  EXPECT_EQ(of_u + of_v, GetParam() == Against::time ? 0. : (-50. + 20.) / (0.5 - 0.2));
}

TEST_P(Tables, GoFromSegmentToSegmentByTheirGuards)
{
  const TableForce element   = table(GetParam());
  const double     corners[] = {0., 0.2, 0.5};
  Eigen::VectorXd  history   = started(element, at(GetParam(), -1.));
  const bool       back      = GetParam() != Against::time;
  for (int k = 0; k < 3; ++k)
  {
    ASSERT_EQ(element.n_guards(history.data()), k > 0 && back ? 2 : 1);
    EXPECT_EQ(element.guards(history.data())[0].kind, "next_segment");
    EXPECT_NEAR(past(element, 0, at(GetParam(), corners[k] - 0.01), history.data()), -0.01, 1e-15);
    element.transition(0, at(GetParam(), corners[k]).motion(true), history.data());
    EXPECT_EQ(history[0], k + 1.);
  }
  ASSERT_EQ(element.n_guards(history.data()), back ? 1 : 0);
  for (int k = 2; k >= 0 && back; --k)
  {
    const int last = element.n_guards(history.data()) - 1;
    EXPECT_EQ(element.guards(history.data())[last].kind, "previous_segment");
    EXPECT_NEAR(past(element, last, at(GetParam(), corners[k] - 0.01), history.data()), 0.01, 1e-15);
    element.transition(last, at(GetParam(), corners[k]).motion(true), history.data());
    EXPECT_EQ(history[0], k);
  }
}
INSTANTIATE_TEST_SUITE_P(All, Tables, ::testing::Values(Against::time, Against::displacement, Against::rate));

TEST(TableForce, StoresTheWorkDoneAgainstIt)
{
  const TableForce element = table(Against::displacement);
  const auto energy = [&](double u) { return element.stored_energy(at(Against::displacement, u).motion(), nullptr); };
  EXPECT_EQ(energy(0.), 0.);
  EXPECT_NEAR(energy(-1.), 10., 1e-12);
  EXPECT_NEAR(energy(0.2), -6., 1e-12);
  EXPECT_NEAR(energy(0.5), -6. + 10.5, 1e-12);
  EXPECT_NEAR(energy(1.5), 4.5 + 50., 1e-12);
  EXPECT_EQ(table(Against::rate).stored_energy(at(Against::rate, 0.3).motion(), nullptr), 0.);
}

TEST(TableForce, TellsItsSteepestResistance)
{
  const double u = 0.;
  double       K, D;
  stiffest(table(Against::displacement), &u, &K, &D);
  EXPECT_DOUBLE_EQ(K, 100.);
  EXPECT_EQ(D, 0.);
  stiffest(table(Against::rate), &u, &K, &D);
  EXPECT_EQ(K, 0.);
  EXPECT_DOUBLE_EQ(D, 100.);
  stiffest(table(Against::time), &u, &K, &D);
  EXPECT_EQ(K + D, 0.);
}

TEST(TableForce, HasNoEventsWhereItHasNoCorners)
{
  const TableForce ramp({Against::time, {{0., 0.}, {1., 0.}, {2., 4.}, {3., 8.}, {3., 8.}, {4., 12.}}});
  Eigen::VectorXd  history = started(ramp, at(Against::time, 0.));
  EXPECT_EQ(past(ramp, 0, at(Against::time, 0.), history.data()), -1.);
  ramp.transition(0, at(Against::time, 1.).motion(true), history.data());
  EXPECT_EQ(past(ramp, 0, at(Against::time, 0.), history.data()), -4.);
  EXPECT_NEAR(force(ramp, at(Against::time, 3.5), history.data(), true)[0], 10., 1e-12);
}

TEST(TableForce, RefusesARowByItsNumber)
{
  const auto refused = [](const std::vector<TableForce::Row> &rows, const std::string &words) {
    expect_refusal([&] { TableForce({Against::time, rows}); }, words);
  };
  refused({{0., 1.}}, "number of rows = 1");
  refused({{0., 1.}, {2., 1.}, {1., 1.}}, "row 3, abscissa = 1, but it must be 2 of the previous row");
  refused({{0., 1.}, {0., 2.}, {0., 3.}}, "row 3, abscissa = 0");
  refused({{0., 1.}, {std::nan(""), 2.}}, "row 2, abscissa");
  refused({{0., 1.}, {1., HUGE_VAL}}, "row 2, force");
  refused({{0., 0.}, {1e-320, 1e10}}, "farther from the previous row");
}

// At rest its stiffness is that of its force, along the load and across it; the rows of a table are met.
TEST(RollingBearing, HasTheStiffnessAndTheEnergyOfItsForce)
{
  const RollingBearing bearing({{{5e-6, 0.}, {1e-5, 800.}, {2e-5, 4500.}}, 2e3, 1e8});
  for (const double r : {0., 3e-6, 8e-6, 1.1e-5, 1.7e-5, 3e-5})
  {
    const Probe probe{0., Eigen::Vector3d(0.6 * r, -0.8 * r, 1e-6), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    Eigen::Vector3d p;
    Eigen::Matrix3d K = Eigen::Matrix3d::Zero(), D = K, dp_du, dp_dv;
    bearing.derivatives(probe.motion(), nullptr, p.data(), dp_du.data(), dp_dv.data());
    bearing.engaged(probe.u.data(), K.data(), D.data());
    EXPECT_LE((K + dp_du).norm(), 1e-12 * K.norm()) << r;
    EXPECT_LE((D + dp_dv).norm(), 1e-12 * D.norm()) << r;
    Probe further = probe, before = probe; // the energy is cubic at most between rows: quotients err by h^2 of F''
    further.u *= 1. + 1e-4, before.u *= 1. - 1e-4;
    const double rise =
        bearing.stored_energy(further.motion(), nullptr) - bearing.stored_energy(before.motion(), nullptr);
    EXPECT_NEAR(rise, -2e-4 * p.dot(probe.u), 1e-7 * std::abs(2e-4 * p.dot(probe.u)) + 1e-19) << r;
  }
  const Probe at_row{0., Eigen::Vector3d(1e-5, 0., 0.), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  EXPECT_NEAR(bearing.quantity(0, at_row.motion(), nullptr), 800., 1e-12 * 800.);
  expect_refusal([] { RollingBearing({{{1e-5, 0.}}, 0., 0.}); }, "last row");
}

} // namespace
} // namespace gestell::tests
