#include "mechanism/elements/connecting_rod.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const ConnectingRod::Parameters crank_press{0.08, 0.8, 9e8, 1.8e5, 1e-4, 4e-4, 5e4};

Probe crank_at(double phi, double s, double y, double phi_rate = 0., double s_rate = 0., double y_rate = 0.)
{
  return {0., Eigen::Vector3d(phi, s, y), Eigen::Vector3d(phi_rate, s_rate, y_rate), Eigen::Vector3d::Zero()};
}

double compression(const ConnectingRod &rod, const Probe &probe)
{
  return rod.quantity(1, probe.motion(), nullptr);
}

TEST(ConnectingRod, CarriesTheSlideByTwiceTheRadiusFromTopToBottom)
{
  const ConnectingRod rod(crank_press);
  EXPECT_NEAR(compression(rod, crank_at(0., 0., 0.)), 0., 1e-16);
  EXPECT_NEAR(compression(rod, crank_at(M_PI, 0., 0.)), 2. * crank_press.crank_radius, 1e-15);
}

TEST(ConnectingRod, CompressionIsThatOfARigidBarBetweenItsEnds)
{
  // A bar from the pin (r sin phi + y across, -r cos phi along) to the slide on its axis has its length at delta = 0.
  const ConnectingRod rod(crank_press);
  const double        phi = 1.1, y = 3e-3;
  const double        slide  = compression(rod, crank_at(phi, 0., y)); // s = -x3 closes the chain for x3 = delta(s = 0)
  const double        across = crank_press.crank_radius * std::sin(phi) + y;
  const double        along =
      (crank_press.length - crank_press.crank_radius) + slide + crank_press.crank_radius * std::cos(phi);
  EXPECT_NEAR(std::hypot(across, along), crank_press.length, 1e-14);
}

TEST(ConnectingRod, ForceIsContinuousAtBothEndsOfThePlay)
{
  const ConnectingRod rod(crank_press);
  for (const double edge : {0., -crank_press.clearance})
  {
    const double u     = compression(rod, crank_at(2., 0., 0.));
    const double above = rod.quantity(0, crank_at(2., edge - u + 1e-13, 0., 0., 0.3).motion(), nullptr);
    const double below = rod.quantity(0, crank_at(2., edge - u - 1e-13, 0., 0., 0.3).motion(), nullptr);
    EXPECT_NEAR(above, below, 4e-13 * crank_press.stiffness); // both contact laws are Lipschitz there
  }
}

TEST(ConnectingRod, PushesSidewaysWithTheTangentOfItsAngle)
{
  const ConnectingRod rod(crank_press);
  const double        phi   = 2.2;
  const double        u     = compression(rod, crank_at(phi, 0., 0.));
  const Probe         probe = crank_at(phi, 2e-4 - u, 0.);
  Eigen::VectorXd     history(1);
  rod.start(probe.motion(), history.data());
  const Eigen::VectorXd p   = force(rod, probe, history.data());
  const double          psi = std::asin(crank_press.crank_radius / crank_press.length * std::sin(phi));
  EXPECT_NEAR(-p[1], crank_press.stiffness * 2e-4, 1e-4);
  EXPECT_NEAR(p[2], -p[1] * std::tan(psi), 1e-8);
  EXPECT_NEAR(rod.quantity(3, probe.motion(), history.data()), -p[1] / std::cos(psi), 1e-6);
}

TEST(ConnectingRod, ClosureHasTheGradientAndCurvatureOfItsCompression)
{
  const ConnectingRod rod(crank_press);
  const Probe         probe = crank_at(2.2, -0.12, 4e-4, 3.1, 0.2, 0.05);
  double              g, gradient[3], curvature;
  ASSERT_TRUE(rod.closure(probe.u.data(), probe.v.data(), g, gradient, curvature));
  // Second difference along v: error O(d^2), rounding 1e-16 / d^2 at d = 1e-4.
  const double d    = 1e-4;
  Probe        plus = probe, minus = probe;
  plus.u += d * probe.v;
  minus.u -= d * probe.v;
  EXPECT_NEAR((compression(rod, plus) - 2. * g + compression(rod, minus)) / (d * d), curvature,
              1e-6 * std::abs(curvature));
  EXPECT_NEAR((compression(rod, plus) - compression(rod, minus)) / (2. * d),
              gradient[0] * 3.1 + gradient[1] * 0.2 + gradient[2] * 0.05, 1e-7);
}

TEST(ConnectingRod, PassesThroughItsPlayByNamedTransitions)
{
  const ConnectingRod rod(crank_press);
  const double        u = compression(rod, crank_at(2., 0., 0.));
  Eigen::VectorXd     history(1);
  rod.start(crank_at(2., 1e-4 - u, 0.).motion(), history.data());
  ASSERT_EQ(rod.guards(history.data())[0].kind, "conrod_open");
  rod.transition(0, crank_at(2., -u, 0.).motion(), history.data());
  ASSERT_EQ(rod.guards(history.data())[1].kind, "conrod_close_tension");
  rod.transition(1, crank_at(2., -4e-4 - u, 0.).motion(), history.data());
  ASSERT_EQ(rod.guards(history.data())[0].kind, "conrod_leave_tension");
  rod.transition(0, crank_at(2., -4e-4 - u, 0.).motion(), history.data());
  ASSERT_EQ(rod.guards(history.data())[0].kind, "conrod_close_compression");
  rod.transition(0, crank_at(2., -u, 0.).motion(), history.data());
  EXPECT_EQ(rod.guards(history.data())[0].kind, "conrod_open");
}

TEST(ConnectingRod, RefusesARodShorterThanItsCrank)
{
  auto wrong   = crank_press;
  wrong.length = 0.07;
  EXPECT_THROW(ConnectingRod{wrong}, std::invalid_argument);
  wrong           = crank_press;
  wrong.clearance = -1e-4;
  EXPECT_THROW(ConnectingRod{wrong}, std::invalid_argument);
  wrong           = crank_press;
  wrong.stiffness = 0.;
  EXPECT_THROW(ConnectingRod{wrong}, std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
