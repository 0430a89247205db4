#include "coupling/integration/events/event_detection.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

LocalState at(double t)
{
  LocalState state;
  state.t = t;
  state.u = Eigen::VectorXd::Constant(1, std::sin(t));
  state.v = Eigen::VectorXd::Constant(1, std::cos(t));
  state.a = Eigen::VectorXd::Zero(1);
  return state;
}

SmallSystem watched_oscillator(double level)
{
  SmallSystem system(Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Identity(1, 1));
  system.set_law(Eigen::VectorXd::Ones(1), [](double, double, double &p, double &du, double &dv) { p = du = dv = 0.; });
  system.watched = true;
  system.level   = level;
  return system;
}

double worst_error(double h)
{
  SmallSystem        system = watched_oscillator(0.4);
  EventDetection     detection(system);
  std::vector<Event> events;
  LocalState         last = at(0.);
  detection.begin(last);
  for (int k = 1; k * h < 20.; ++k)
  {
    const LocalState now = at(k * h);
    detection.step(last, now, events);
    last = now;
  }
  double error = 0.;
  for (std::size_t i = 0; i < events.size(); ++i)
  {
    const double up = std::asin(0.4) + M_PI * static_cast<double>(i - i % 2);
    error           = std::max(error, std::abs(events[i].t - (i % 2 == 0 ? up : up + M_PI - 2. * std::asin(0.4))));
  }
  EXPECT_EQ(events.size(), 7u);
  EXPECT_EQ(events[0].kind, "up");
  EXPECT_EQ(events[1].kind, "down");
  return error;
}

TEST(EventDetection, TimesAreExactToTheFourthOrderOfTheCubic)
{
  const double coarse = worst_error(0.1), fine = worst_error(0.05);
  EXPECT_LT(coarse, 1e-6); // h^4/384 max|u''''| / |u'| = 3e-7
  EXPECT_GT(std::log2(coarse / fine), 3.);
}

/// With one guard that is any function of the state and rises.
class WatchedSystem final : public SmallSystem
{
public:
  explicit WatchedSystem(std::function<double(const LocalState &)> guard_function)
      : SmallSystem(watched_oscillator(0.)), function(std::move(guard_function))
  {
  }
  int           n_guards() const override { return transitions == 0 ? 1 : 0; }
  void          guard_values(const LocalState &state, Vector &g) const override { g[0] = function(state); }
  GuardCrossing crossing(int) const override { return GuardCrossing::rising; }

  std::function<double(const LocalState &)> function;
};

/// u = t^3, with a force, an acceleration and a multiplier that grow along lines.
LocalState cubic_at(double t)
{
  LocalState state = at(t);
  state.u[0]       = t * t * t;
  state.v[0]       = 3. * t * t;
  state.a[0]       = 6. * t;
  state.p          = Eigen::VectorXd::Constant(1, 5. - 4. * t);
  state.lambda     = Eigen::VectorXd::Constant(1, 2. + 7. * t);
  return state;
}

TEST(EventDetection, OfACubicMotionWithLinearForcesHasNoError)
{
  // Whatever of a state a guard looks at is found between the instants as it is there, in a step of any length.
  const double                                                             t = 1.31, begin = 0.4, end = 2.;
  const std::pair<const char *, std::function<double(const LocalState &)>> guards[] = {
      {"displacement", [&](const LocalState &state) { return state.u[0] - t * t * t; }},
      {"rate", [&](const LocalState &state) { return state.v[0] - 3. * t * t; }},
      {"acceleration", [&](const LocalState &state) { return state.a[0] - 6. * t; }},
      {"force", [&](const LocalState &state) { return 5. - 4. * t - state.p[0]; }},
      {"multiplier", [&](const LocalState &state) { return state.lambda[0] - 2. - 7. * t; }}};
  for (const auto &[what, guard] : guards)
  {
    WatchedSystem      system(guard);
    EventDetection     detection(system);
    std::vector<Event> events;
    detection.begin(cubic_at(begin));
    detection.step(cubic_at(begin), cubic_at(end), events);
    ASSERT_EQ(events.size(), 1u) << what;
    EXPECT_NEAR(events[0].t, t, 1e-11 * (end - begin)) << what << ": located to 1e-12 of the step";
  }
}

TEST(EventDetection, TakesTheTransitionsOfOneStepInTheirOrder)
{
  // From below the level to above it and, watched from the other side since then, down again: two steps of a sine.
  SmallSystem        system = watched_oscillator(0.4);
  EventDetection     detection(system);
  std::vector<Event> events;
  detection.begin(at(0.1));
  detection.step(at(0.1), at(1.5), events);
  detection.step(at(1.5), at(3.), events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, "up");
  EXPECT_EQ(events[1].kind, "down");
  EXPECT_LT(events[0].t, events[1].t);
}

TEST(EventDetection, DoesNotFireAgainAtItsOwnStartingPoint)
{
  SmallSystem        system = watched_oscillator(0.);
  EventDetection     detection(system);
  std::vector<Event> events;
  LocalState         before = at(-0.1), zero = at(0.), after = at(0.1);
  zero.u[0] = 0.;
  detection.begin(before);
  detection.step(before, zero, events);
  detection.step(zero, after, events);
  EXPECT_EQ(events.size(), 1u);
}

} // namespace
} // namespace gestell::tests
