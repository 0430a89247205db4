#include "mechanism/user_force.h"

#include "mechanism/elements/cubic_spring.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

#include <limits>

namespace gestell::tests
{
namespace
{

using namespace mechanism;

constexpr double c = 900., c3 = 5e6;

UserLaw cubic_law()
{
  UserLaw law;
  law.force      = [](Numbers x, Numbers, double *y, int) { y[0] = -c * x.begin[1] - c3 * std::pow(x.begin[1], 3); };
  law.derivative = [](Numbers x, Numbers, double *y, int)
  {
    y[0] = -c - 3. * c3 * x.begin[1] * x.begin[1];
    y[1] = 0.;
  };
  return law;
}

TEST(UserForce, IsTheCubicSpringOfItsFunctions)
{
  const CubicSpring spring({c, c3});
  const UserForce   own(cubic_law());
  for (const double at : {-0.02, 0., 1e-3, 0.05})
  {
    const Probe          probe = probe1(at, 0.3);
    const TangentWeights w{1., 2e3, 4e6};
    double               p, dp, expected, slope, K, D;
    own.tangent(probe.motion(), nullptr, w, &p, &dp);
    spring.tangent(probe.motion(), nullptr, w, &expected, &slope);
    EXPECT_NEAR(p, expected, 1e-14 * std::abs(expected)); // two sums of the same terms
    EXPECT_NEAR(dp, slope, 1e-14 * std::abs(slope));
    own.engaged(&at, &K, &D);
    EXPECT_NEAR(K, -slope, 1e-14 * std::abs(slope));
    EXPECT_EQ(D, 0.);
  }
}

/// The error of central differences of a polynomial of third degree is c3 d^2, d = 6e-6 max(|u|, 1 mm), and rounding.
TEST(UserForce, HasDifferencesOfTheStatedError)
{
  UserLaw law    = cubic_law();
  law.derivative = {};
  const UserForce differences(law), exact(cubic_law());
  for (const double at : {-0.5, 0., 1e-3, 3.})
  {
    const Probe probe = probe1(at, 0.3);
    double      p, K, D, K_exact, D_exact;
    differences.derivatives(probe.motion(), nullptr, &p, &K, &D);
    exact.derivatives(probe.motion(), nullptr, &p, &K_exact, &D_exact);
    const double d = 6.1e-6 * std::max(std::abs(at), 1e-3);
    EXPECT_NEAR(K, K_exact, 1.01 * c3 * d * d + 1e-16 * std::abs(p) / d + 1e-10 * std::abs(K_exact)) << at;
    EXPECT_EQ(D, 0.);
  }
}

TEST(UserForce, HasTheStateAndEventsOfItsFunctions)
{
  UserLaw law;
  law.state        = {0., -1.};
  law.events       = {"passes", "returns"};
  law.force        = [](Numbers, Numbers s, double *y, int) { y[0] = s.begin[0] + s.begin[1]; };
  law.event_values = [](Numbers x, Numbers, double *y, int)
  {
    y[0] = x.begin[1] - 0.1;
    y[1] = 0.1 - x.begin[1];
  };
  law.at_event = [](Numbers x, Numbers s, double *y, int)
  {
    y[0] = s.begin[0];
    y[1] = 10. + x.begin[0];
  };
  law.after_step = [](Numbers x, Numbers s, double *y, int)
  {
    y[0] = std::max(s.begin[0], x.begin[2]);
    y[1] = s.begin[1];
  };
  const UserForce own(law);
  Eigen::VectorXd history = started(own, probe1(0., 0.3));
  EXPECT_EQ(own.guards(history.data())[1].kind, "returns");
  EXPECT_LT(past(own, 0, probe1(0., 0.3), history.data()), 0.);
  EXPECT_GT(past(own, 0, probe1(0.2, 0.3), history.data()), 0.);
  EXPECT_LT(past(own, 1, probe1(0., 0.3), history.data()), 0.) << "its number did not rise through zero";
  own.accept(probe1(0., 0.3).motion(), history.data());
  own.transition(1, probe1(0.1, 0.3).motion(), history.data());
  EXPECT_EQ(history.head(2), Eigen::Vector2d(0.3, 11.));
  EXPECT_DOUBLE_EQ(force(own, probe1(0., 0.), history.data())[0], 11.3);
}

/// Without a function that changes its number, an event occurs once, and again after the number was negative.
TEST(UserForce, AnEventOccursWhereItsNumberRises)
{
  UserLaw law;
  law.events       = {"passes"};
  law.force        = [](Numbers, Numbers, double *y, int) { y[0] = 0.; };
  law.event_values = [](Numbers x, Numbers, double *y, int) { y[0] = x.begin[1] - 0.1; };
  const UserForce own(law);
  Eigen::VectorXd history = started(own, probe1(0., 0.));
  const auto      at      = [&](double u) { return past(own, 0, probe1(u, 0.), history.data()); };
  EXPECT_GT(at(0.2), 0.);
  own.transition(0, probe1(0.1, 0.).motion(), history.data());
  EXPECT_LT(at(0.2), 0.);
  own.accept(probe1(0.2, 0.).motion(), history.data());
  EXPECT_LT(at(0.2), 0.);
  own.accept(probe1(0.05, 0.).motion(), history.data());
  EXPECT_GT(at(0.2), 0.);
}

TEST(UserForce, HasNoValueWhereAFunctionThrows)
{
  UserLaw law;
  law.force = [](Numbers x, Numbers, double *y, int)
  {
    y[0] = 3.;
    if (x.begin[1] > 1.)
      throw std::runtime_error("raised");
  };
  const UserForce own(law);
  EXPECT_EQ(own.fault(-1.), "");
  EXPECT_TRUE(std::isnan(force(own, probe1(2., 0.), nullptr)[0]));
  EXPECT_EQ(force(own, probe1(0., 0.), nullptr)[0], 3.);
  EXPECT_EQ(own.fault(-1.), "its function 'force' raised");
  EXPECT_EQ(own.fault(std::numeric_limits<double>::infinity()), "") << "not after that instant";
}

TEST(UserForce, HasNoValueAnyMoreOnceItsStateIsLost)
{
  UserLaw law;
  law.state      = {0.};
  law.force      = [](Numbers, Numbers, double *y, int) { y[0] = 3.; };
  law.after_step = [](Numbers, Numbers, double *, int) { throw std::runtime_error("raised"); };
  const UserForce own(law);
  double          state = 0.; // without events
  EXPECT_EQ(force(own, probe1(0., 0.), &state)[0], 3.);
  own.accept(probe1(0., 0.).motion(), &state);
  EXPECT_TRUE(std::isnan(force(own, probe1(0., 0.), &state)[0]));
  EXPECT_EQ(own.fault(-1.), "its function 'after_step' raised");
}

TEST(UserForce, MayBeUndefinedAtSomePoints)
{
  UserLaw law;
  law.force = [](Numbers x, Numbers, double *y, int) { y[0] = std::sqrt(x.begin[1]); };
  const UserForce own(law);
  EXPECT_TRUE(std::isnan(force(own, probe1(-1., 0.), nullptr)[0]));
  EXPECT_EQ(force(own, probe1(4., 0.), nullptr)[0], 2.);
  EXPECT_EQ(own.fault(-1.), "");
}

TEST(UserForce, RefusesFunctionsThatDoNotBelongTogether)
{
  EXPECT_THROW(UserForce({}), std::invalid_argument);
  UserLaw no_values = cubic_law(), no_state = cubic_law();
  no_values.events    = {"contact"};
  no_state.after_step = [](Numbers, Numbers, double *, int) {};
  EXPECT_THROW(UserForce{no_values}, std::invalid_argument);
  EXPECT_THROW(UserForce{no_state}, std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
