#include "mechanism/elements/coulomb_friction.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

/// m u'' + c u = p with the friction p, followed exactly from event to event: harmonic about p/c while it slips,
/// uniform with p = c u while it is held.
class FrictionOscillator
{
public:
  struct Event
  {
    double      t, u;
    std::string kind;
  };

  static constexpr double m = 1., c = 100., omega = 10.;

  FrictionOscillator(const CoulombFriction::Parameters &parameters, double u, double v)
      : friction_(parameters), u_(u), v_(v)
  {
    friction_.start(probe1(u, v).motion(true), history_);
  }

  /// Events up to the time end: due where a guard is past zero behind the time step, at its beginning if already past
  /// there.
  std::vector<Event> events(double end)
  {
    constexpr double   step = 1e-3;
    std::vector<Event> found;
    while (t_ < end)
    {
      bool taken = false;
      for (int i = 0; i < friction_.n_guards(history_) && !taken; ++i)
      {
        if (past_after(i, step) <= 0.)
          continue;
        double open = 0., due = step;
        while (past_after(i, open) < 0. && due - open > 1e-15)
        {
          const double middle                       = 0.5 * (open + due);
          (past_after(i, middle) < 0. ? open : due) = middle;
        }
        advance(past_after(i, open) < 0. ? due : open);
        found.push_back({t_, u_, friction_.guards(history_)[i].kind});
        const double p = force_after(0.);
        friction_.transition(i, after(0.).motion(true, &p), history_);
        taken = true;
      }
      if (!taken)
        advance(step);
    }
    return found;
  }

  bool held() const
  {
    double rate;
    return friction_.holds(history_, rate);
  }

private:
  double force_after(double dt) const
  {
    if (held())
      return c * after(dt).u[0];
    double p;
    friction_.force(probe1(u_, v_).motion(true), history_, &p);
    return p;
  }

  Probe after(double dt) const
  {
    double rate;
    if (friction_.holds(history_, rate))
      return probe1(u_ + rate * dt, rate);
    double p;
    friction_.force(probe1(u_, v_).motion(true), history_, &p);
    const double centre = p / c, cosine = std::cos(omega * dt), sine = std::sin(omega * dt);
    return probe1(centre + (u_ - centre) * cosine + v_ / omega * sine, v_ * cosine - (u_ - centre) * omega * sine);
  }

  double past_after(int guard, double dt) const
  {
    const double p = force_after(dt);
    return past(friction_, guard, after(dt), history_, &p);
  }

  void advance(double dt)
  {
    const Probe next = after(dt);
    t_ += dt, u_ = next.u[0], v_ = next.v[0];
  }

  CoulombFriction friction_;
  double          t_ = 0., u_, v_, history_[8] = {};
};

// Half a period takes 2 R/c off the amplitude; the slide rests for good where |c u| <= R0.  The oscillator adds up
// thousands of exact steps: 1e-11 covers their rounding, here and below.
TEST(CoulombFriction, LetsAFreeVibrationFallByEqualAmountsUntilItSticks)
{
  const double       R = 3.;
  FrictionOscillator oscillator({R, R, 0.}, 0.5, 0.);
  const auto         events = oscillator.events(4.);
  // It starts at rest under a load too large to hold; each turning point is a stick that ends at once.
  ASSERT_EQ(events.size(), 1u + 2u * 7u + 1u);
  EXPECT_EQ(events[0].kind, "slip_backward");
  EXPECT_EQ(events[0].t, 0.);
  double u = 0.5;
  for (int j = 1; j <= 8; ++j)
  {
    const auto &stop = events[2 * j - 1];
    u                = -(u > 0. ? u - 2. * R / FrictionOscillator::c : u + 2. * R / FrictionOscillator::c);
    EXPECT_EQ(stop.kind, "stick");
    EXPECT_NEAR(stop.t, j * M_PI / FrictionOscillator::omega, 1e-11);
    EXPECT_NEAR(stop.u, u, 1e-11);
    if (j == 8)
      break;
    EXPECT_EQ(events[2 * j].kind, u > 0. ? "slip_backward" : "slip_forward");
    EXPECT_EQ(events[2 * j].t, stop.t);
  }
  EXPECT_TRUE(oscillator.held());
}

// On a belt: held from u = (2 R - R0)/c to R0/c, then one swing about R/c that reaches the belt's speed again.
TEST(CoulombFriction, StickSlipOnABeltHasItsExactCycle)
{
  constexpr double R = 4., R0 = 6., v_b = 0.1, c = FrictionOscillator::c, omega = FrictionOscillator::omega;
  for (const double direction : {1., -1.})
  {
    FrictionOscillator oscillator({R, R0, direction * v_b}, 0., direction * v_b);
    const auto         events = oscillator.events(5.);
    const double       slip  = 2. * (M_PI - std::atan((R0 - R) / (v_b * std::sqrt(c * FrictionOscillator::m)))) / omega;
    const double       stick = 2. * (R0 - R) / (c * v_b);
    ASSERT_GE(events.size(), 8u);
    for (std::size_t i = 0; i < events.size(); ++i)
    {
      const auto  n       = static_cast<double>(i / 2);
      const bool  lets_go = i % 2 == 0;
      const char *away    = direction > 0. ? "slip_backward" : "slip_forward"; // against the belt
      EXPECT_EQ(events[i].kind, lets_go ? away : "stick");
      EXPECT_NEAR(events[i].t, R0 / (c * v_b) + n * (slip + stick) + (lets_go ? 0. : slip), 1e-11);
      EXPECT_NEAR(events[i].u, direction * (lets_go ? R0 : 2. * R - R0) / c, 1e-11);
    }
  }
}

TEST(CoulombFriction, HoldsUpToItsStaticForceAndReleasesTheWayItIsPulled)
{
  const CoulombFriction friction({4., 6., 0.2});
  double                rate = 0., history[8] = {7.};
  ASSERT_EQ(friction.n_history(), 8);
  friction.start(probe1(0., 0.2).motion(), history);
  ASSERT_TRUE(friction.holds(history, rate));
  EXPECT_EQ(rate, 0.2);
  for (const double p : {-5.999, 0., 5.999})
  {
    EXPECT_LT(past(friction, 0, probe1(0., 0.2), history, &p), 0.);
    EXPECT_LT(past(friction, 1, probe1(0., 0.2), history, &p), 0.);
    EXPECT_EQ(friction.quantity(0, probe1(0., 0.2).motion(true, &p), history), -p);
  }
  const double pulled_forward = -6.001;
  EXPECT_GT(past(friction, 0, probe1(0., 0.2), history, &pulled_forward), 0.);
  EXPECT_LT(past(friction, 1, probe1(0., 0.2), history, &pulled_forward), 0.);
  friction.transition(0, probe1(0., 0.2).motion(true, &pulled_forward), history);
  EXPECT_FALSE(friction.holds(history, rate));
  EXPECT_EQ(force(friction, probe1(0., 0.2), history, true)[0], -4.); // it resists the way it now goes
  EXPECT_LT(past(friction, 0, probe1(0., 0.2001), history), 0.);
  EXPECT_GT(past(friction, 0, probe1(0., 0.1999), history), 0.);
}

TEST(CoulombFriction, KeepsItsForceBeyondTheEndOfASlipWhenFollowedByHistory)
{
  const CoulombFriction friction({4., 6., 0.});
  const double          forward[8] = {1.}, held[8] = {};
  EXPECT_EQ(force(friction, probe1(0., -1e-9), forward, true)[0], -4.);
  EXPECT_EQ(force(friction, probe1(0., -1e-9), forward, false)[0], 4.);
  EXPECT_EQ(force(friction, probe1(0., 0.), held, false)[0], 0.);
}

TEST(CoulombFriction, CountsABeltAsADrive)
{
  EXPECT_EQ(CoulombFriction({4., 6., 0.}).work(), Work::dissipated);
  EXPECT_EQ(CoulombFriction({4., 6., 0.1}).work(), Work::input);
}

TEST(CoulombFriction, RefusesAStaticForceBelowTheKineticOne)
{
  EXPECT_THROW(CoulombFriction({4., 3., 0.}), std::invalid_argument);
  EXPECT_THROW(CoulombFriction({-1., 3., 0.}), std::invalid_argument);
  EXPECT_THROW(CoulombFriction({1., 3., std::nan("")}), std::invalid_argument);
  EXPECT_THROW(CoulombFriction({1., HUGE_VAL, 0.}), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
