// A single stop: one side of a play, and the restitution of its law.

#include "mechanism/elements/clearance.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;
using Stops = Clearance::Stops;

TEST(Stop, IsOneSideOfAPlay)
{
  const Clearance play({5e-5, 1e9, 4.}), above({5e-5, 1e9, 4., Stops::above}), below({5e-5, 1e9, 4., Stops::below});
  for (const double u : {-9e-5, -6e-5, -1e-5, 2e-5, 6e-5})
    for (const double v : {-0.3, 0.1, 0.3})
    {
      const Probe  probe = probe1(u, v);
      const double both  = force(play, probe, started(play, probe).data())[0];
      EXPECT_EQ(force(above, probe, started(above, probe).data())[0], u > 0. ? both : 0.);
      EXPECT_EQ(force(below, probe, started(below, probe).data())[0], u < 0. ? both : 0.);
      EXPECT_EQ(above.stored_energy(probe.motion(), nullptr),
                u > 0. ? play.stored_energy(probe.motion(), nullptr) : 0.);
    }
}

TEST(Stop, MayStandOnTheOtherSideOfZero)
{
  const Clearance pressed({-1e-3, 1e6, 0., Stops::above}), below({-1e-3, 1e6, 0., Stops::below});
  EXPECT_NEAR(force(pressed, probe1(0., 0.), started(pressed, probe1(0., 0.)).data())[0], -1e3, 1e-9);
  EXPECT_NEAR(force(below, probe1(0., 0.), started(below, probe1(0., 0.)).data())[0], 1e3, 1e-9);
  EXPECT_EQ(force(pressed, probe1(-2e-3, 0.), started(pressed, probe1(-2e-3, 0.)).data())[0], 0.);
}

TEST(Stop, TellsTouchDownAndLiftOff)
{
  for (const double s : {1., -1.})
  {
    const Clearance stop({-1e-3, 1e6, 4., s > 0. ? Stops::above : Stops::below});
    Eigen::VectorXd history = started(stop, probe1(s * -2e-3, 0.));
    ASSERT_EQ(stop.n_guards(history.data()), 1);
    EXPECT_EQ(stop.guards(history.data())[0].kind, "contact");
    EXPECT_NEAR(past(stop, 0, probe1(s * -1.1e-3, 0.), history.data()), -1e-4, 1e-15);
    stop.transition(0, probe1(s * -1e-3, s * 0.1).motion(true), history.data());
    ASSERT_EQ(stop.n_guards(history.data()), 2);
    EXPECT_NEAR(force(stop, probe1(0., 0.), history.data(), true)[0], s * -1e3, 1e-9);
    EXPECT_NEAR(past(stop, 0, probe1(s * -0.9e-3, 0.), history.data()), -1e-4, 1e-15);
    EXPECT_EQ(stop.guards(history.data())[0].kind, "separation");
    EXPECT_EQ(stop.guards(history.data())[1].kind, "contact_slack");
    EXPECT_GT(past(stop, 1, probe1(0., s * -0.3), history.data()), 0.);
    stop.transition(1, probe1(0., s * -0.25).motion(true), history.data());
    EXPECT_EQ(stop.guards(history.data())[1].kind, "contact_grip");
    EXPECT_EQ(force(stop, probe1(0., s * -0.3), history.data(), true)[0], 0.);
    stop.transition(0, probe1(s * -1e-3, s * -0.3).motion(true), history.data());
    EXPECT_EQ(stop.n_guards(history.data()), 1);
  }
}

TEST(Stop, IsStiffWhenEngaged)
{
  const Clearance stop({0., 3e6, 4., Stops::below});
  const double    u = 1.;
  double          K = 0., D = 1.;
  stop.engaged(&u, &K, &D);
  EXPECT_EQ(K, 3e6);
  EXPECT_EQ(D, 0.);
}

/// Speed at which a free mass leaves the stop it meets at v, by Runge-Kutta of fourth order.
double rebound(double mass, double c, double chi, double v)
{
  const Clearance stop({0., c, chi, Stops::above});
  const double    h = 1e-4 * M_PI * std::sqrt(mass / c), history = 1.;
  double          u            = 0.;
  const auto      acceleration = [&](double x, double rate)
  { return force(stop, probe1(x, rate), &history, true)[0] / mass; };
  while (true)
  {
    const double a1 = acceleration(u, v), a2 = acceleration(u + 0.5 * h * v, v + 0.5 * h * a1);
    const double a3   = acceleration(u + 0.5 * h * v + 0.25 * h * h * a1, v + 0.5 * h * a2);
    const double a4   = acceleration(u + h * v + 0.5 * h * h * a2, v + h * a3);
    const double next = u + h * v + h * h / 6. * (a1 + a2 + a3);
    if (next < 0.) // a vanishes there
      return v;
    u = next;
    v += h / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
  }
}

TEST(Restitution, IsWhatAFreeBodyKeepsOfItsSpeed)
{
  for (const double e : {0.3, 0.6, 0.9, 0.99, 0.99995})
    for (const double v : {0.2, 5.})
      EXPECT_NEAR(-rebound(7., 3e6, Clearance::dissipation_for(e, v), v) / v, e, 1e-6) << e << " at " << v;
}

TEST(Restitution, OfOneLosesNothingAndNearOneIsTheKnownRule)
{
  EXPECT_EQ(Clearance::dissipation_for(1., 2.), 0.);
  EXPECT_NEAR(Clearance::dissipation_for(0.999, 2.) * 2., 1.5e-3, 5e-6); // e = 1 - (2/3) chi v
  // Both branches of the calculation meet.
  EXPECT_NEAR(Clearance::dissipation_for(1. - 1.0001e-4, 1.) / Clearance::dissipation_for(1. - 0.9999e-4, 1.),
              1.0001 / 0.9999, 1e-6);
}

TEST(Restitution, RefusesWhatMakesNoSense)
{
  EXPECT_THROW(Clearance::dissipation_for(0., 1.), std::invalid_argument);
  EXPECT_THROW(Clearance::dissipation_for(1.1, 1.), std::invalid_argument);
  EXPECT_THROW(Clearance::dissipation_for(0.5, 0.), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
