// Events located and the integration restarted there: times against exact solutions (tests/reference/numerics/order).

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/machine/machine.h"
#include "mechanism/elements/coulomb_friction.h"
#include "tests/support/methods.h"
#include "tests/support/reference_table.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;

/// m x'' + c x' + k x = F0 + F cos(Omega t + phase) - [x > gap](kw (x - gap) + cw x')
struct Wall
{
  const char *name;
  double      m, c, k, F, Omega, phase, gap, kw, cw, v0, end;
};

/// The wall as SmallSystem's one law with its one guard: in contact after every odd transition.
class WallSystem : public SmallSystem
{
public:
  explicit WallSystem(const Wall &wall)
      : SmallSystem(Eigen::MatrixXd::Constant(1, 1, wall.m), Eigen::MatrixXd::Constant(1, 1, wall.c),
                    Eigen::MatrixXd::Constant(1, 1, wall.k))
  {
    if (wall.F != 0.)
      loads().add_harmonic(0, wall.Omega, wall.F * std::cos(wall.phase), -wall.F * std::sin(wall.phase));
    watched = true;
    level   = wall.gap;
    set_law(Vector::Ones(1),
            [this, wall](double u, double v, double &p, double &du, double &dv)
            {
              const double on = transitions % 2;
              p               = -on * (wall.kw * (u - wall.gap) + wall.cw * v);
              du              = -on * wall.kw;
              dv              = -on * wall.cw;
            });
  }
};

const Wall walls[] = {{"impact1", 1., 0., 0., 0., 1., 0., 0.1, 1e6, 0., 2., 0.1},
                      {"impact2", 10., 20., 4000., 400., 18., 0., 0.05, 4e6, 0., 0., 2.},
                      {"impact3", 1., 0.2, 100., 30., 8., -M_PI / 2., 0.2, 1e5, 60., 0., 5.}};

std::vector<double> event_times(const std::string &file, const std::string &name)
{
  std::vector<double> times;
  for (const ReferenceRow &row : read_reference(file))
    if (row["case"] == name)
      times.push_back(row.number("t"));
  return times;
}

/// Times at which each event of the file comes, against those of a run; the largest difference.
double largest_time_error(const std::vector<Event> &events, const std::vector<double> &expected)
{
  EXPECT_EQ(events.size(), expected.size());
  double largest = 0.;
  for (std::size_t i = 0; i < std::min(events.size(), expected.size()); ++i)
    largest = std::max(largest, std::abs(events[i].t - expected[i]));
  return largest;
}

std::vector<Event> events_of_run(SecondOrderSystem &system, const MethodOptions &method, const Vector &q,
                                 const Vector &v, double end)
{
  const auto  integrator = make_integrator(system, method);
  EventDriver driver(system, *integrator, EventOptions());
  driver.begin(0., q, v);
  while (integrator->time() < end - 1e-12)
    driver.advance();
  std::vector<Event> events;
  for (const Event &event : driver.events())
    if (event.t <= end)
      events.push_back(event);
  return events;
}

MethodOptions exact(double tolerance)
{
  MethodOptions method    = tests::controlled(tests::method("exact", 0.02, 6), tolerance);
  method.newton.tolerance = 1e-13;
  return method;
}

using WallSpring = ::testing::TestWithParam<Wall>;

TEST_P(WallSpring, EventsOfExactPropagationAreRightToTheNanosecond)
{
  const Wall &wall = GetParam();
  WallSystem  system(wall);
  const auto  expected = event_times("order/c_impact_events.csv", wall.name);
  const auto  events   = events_of_run(system, exact(1e-10), Vector::Zero(1), Vector::Constant(1, wall.v0), wall.end);
  EXPECT_LT(largest_time_error(events, expected), 1e-9);
}

// A whole period in one step: begin, middle and end are alike, and the wall is reached and left between them.
TEST(LocatedEvents, AreNotMissedWhereBeginMiddleAndEndOfAStepAreAlike)
{
  const double  omega = 2. * M_PI, way = 0.9;
  WallSystem    system({"", 1., 0., omega * omega, 0., 1., 0., way, 0., 0., omega, 1.});
  MethodOptions method = exact(0.);
  method.step          = 1.;
  const auto events    = events_of_run(system, method, Vector::Zero(1), Vector::Constant(1, omega), 1.);
  ASSERT_GE(events.size(), 2u); // at the level itself rounding may turn the guard once more
  EXPECT_NEAR(events.front().t, std::asin(way) / omega, 1e-9);
  EXPECT_NEAR(events.back().t, 0.5 - std::asin(way) / omega, 1e-9);
}

// A sine that stands 1e-4 of its amplitude above the wall, in a period of one step from any phase: begin and end of
// some part of it are alike, and all that is looked at lies below.
TEST(LocatedEvents, AreNotMissedWhereAPeakJustReachesOver)
{
  const double omega = 2. * M_PI, way = 1. - 1e-4, reached = std::asin(way);
  for (int k = 0; k < 60; ++k)
  {
    const double phase = omega * k / 60.;
    if (std::sin(phase) > way)
      continue;
    WallSystem    system({"", 1., 0., omega * omega, 0., 1., 0., way, 0., 0., 0., 1.});
    MethodOptions method = exact(0.);
    method.step          = 1.;
    const auto events    = events_of_run(system, method, Vector::Constant(1, std::sin(phase)),
                                         Vector::Constant(1, omega * std::cos(phase)), 1.);
    ASSERT_GE(events.size(), 2u) << k;
    EXPECT_NEAR(events.front().t, std::fmod(reached - phase + omega, omega) / omega, 1e-8) << k;
  }
}

TEST_P(WallSpring, EventsOfBdf2ComeWithItsOrder)
{
  const Wall  &wall     = GetParam();
  const auto   expected = event_times("order/c_impact_events.csv", wall.name);
  const double end      = std::min(wall.end, 0.5 * (expected[1] + (expected.size() > 2 ? expected[2] : wall.end)));
  double       error[2];
  for (int k = 0; k < 2; ++k)
  {
    WallSystem system(wall);
    const auto events =
        events_of_run(system, bdf(2, std::ldexp(1e-4, -k)), Vector::Zero(1), Vector::Constant(1, wall.v0), end);
    error[k] = largest_time_error(events, {expected[0], expected[1]});
  }
  EXPECT_GT(error[0] / error[1], 3.) << error[0] << " " << error[1]; // second order: 4
}
INSTANTIATE_TEST_SUITE_P(Walls, WallSpring, ::testing::ValuesIn(walls),
                         [](const auto &info) { return std::string(info.param.name); });

std::vector<MethodOptions> all_methods()
{
  std::vector<MethodOptions> all;
  for (const IntegrationMethod *method : integration_methods())
    for (ChartSetting &setting : method->chart_settings())
    {
      setting.options.step = 1e-2;
      if (setting.controlled)
        setting.options.tolerance = 1e-6;
      all.push_back(setting.options);
    }
  return all;
}

/// A free mass that moves at 1 m/s away from the level, out of the range past it.
class LeavingMass : public WallSystem
{
public:
  explicit LeavingMass(double level) : WallSystem({"", 1., 0., 0., 0., 1., 0., level, 0., 0., 0., 1.}) {}

  /// From `u` by each method: the instant of its first event, NaN where there is none.
  static std::vector<std::pair<std::string, double>> first_events(double u, double level)
  {
    std::vector<std::pair<std::string, double>> found;
    for (const MethodOptions &method : all_methods())
    {
      LeavingMass system(level);
      const auto  events = events_of_run(system, method, Vector::Constant(1, u), Vector::Constant(1, -1.), 0.1);
      found.emplace_back(method_name(method), events.empty() ? std::nan("") : events.front().t);
    }
    return found;
  }
};

TEST(LocatedEvents, BeginWithAGuardThatIsClearlyPastHoweverLongTheFirstStep)
{
  for (const double past : {1e-2, 1e-5, 1e-9})
    for (const auto &[method, t] : LeavingMass::first_events(0.3 + past, 0.3))
      EXPECT_EQ(t, 0.) << method << ", past by " << past;
}

TEST(LocatedEvents, AreNoneWhereAGuardBeginsAtZeroOrPastItByRounding)
{
  for (const double past : {0., 1e-16})
    for (const auto &[method, t] : LeavingMass::first_events(0.3 + past, 0.3))
      EXPECT_TRUE(std::isnan(t)) << method << ", past by " << past << ": " << t;
}

/// Watches the level only from t = 0.015 s on: another object's event, within the second step.
class WaitingForAnInstant : public LeavingMass
{
public:
  using LeavingMass::LeavingMass;
  void guard_values(const LocalState &state, Vector &g) const override
  {
    if (transitions == 0)
      g[0] = state.t - 0.015;
    else
      LeavingMass::guard_values(state, g);
  }
  GuardCrossing crossing(int) const override
  {
    return transitions == 0 || transitions % 2 == 1 ? GuardCrossing::rising : GuardCrossing::falling;
  }
  ActiveGuard guard(int) const override { return {transitions == 0 ? "clock" : "oscillator", ""}; }
};

TEST(LocatedEvents, FollowAtOnceWhereAGuardIsClearlyPastWhenItIsWatchedFirst)
{
  for (const MethodOptions &method : all_methods())
  {
    WaitingForAnInstant system(0.3);
    const auto events = events_of_run(system, method, Vector::Constant(1, 0.3151), Vector::Constant(1, -1.), 0.1);
    ASSERT_EQ(events.size(), 3u) << method_name(method);
    EXPECT_NEAR(events[0].t, 0.015, 1e-12) << method_name(method);
    EXPECT_EQ(events[1].t, events[0].t) << method_name(method); // 0.1 mm past the level
    EXPECT_NEAR(events[2].t, 0.0151, 1e-9) << method_name(method);
  }
}

/// m x'' + c x' + k x + friction = F cos(Omega t)
struct Rubbing
{
  const char *name;
  double      c, R, R0, belt, F, Omega, x0, v0, end;
};

const Rubbing rubbing[] = {{"coulomb1", 0., 3., 3., 0., 0., 1., 0.5, 0., 4.},
                           {"coulomb2", 0.5, 4., 6., 0.1, 0., 1., 0., 0.1, 5.},
                           {"coulomb3", 0., 6., 6., 0., 10., 4., 0., 0., 8.}};

Machine rubbing_mass(const Rubbing &r)
{
  MachineModel model;
  const int    x = model.add_slider("mass", {1., 0., 0.}, 1., "ground");
  model.add_linear("spring", {{x, 1.}}, {100., r.c, 0., 0.}, "N");
  if (r.F != 0.)
    model.add_load("drive", {{x, 1.}}, 0., {{r.Omega, r.F, M_PI / 2.}}, "N");
  model.attach("belt",
               std::make_shared<mechanism::CoulombFriction>(mechanism::CoulombFriction::Parameters{r.R, r.R0, r.belt}),
               {{{x, 1.}}});
  return Machine(std::move(model));
}

class StickSlip : public ::testing::TestWithParam<Rubbing>
{
public:
  /// Times of the events as the file counts them: a reversal, stick and slip at one instant, is one of them.
  static std::vector<double> times(const std::vector<Event> &events, double apart = 1e-12)
  {
    std::vector<double> times;
    for (const Event &event : events)
      if (event.t > 0. && (times.empty() || event.t > times.back() + apart))
        times.push_back(event.t);
    return times;
  }
};

TEST_P(StickSlip, EventsAreRightToTheNanosecond)
{
  const Rubbing &r        = GetParam();
  Machine        machine  = rubbing_mass(r);
  const auto     expected = event_times("order/d_coulomb_events.csv", r.name);
  const auto     found =
      times(events_of_run(machine, exact(1e-12), Vector::Constant(1, r.x0), Vector::Constant(1, r.v0), r.end));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

TEST_P(StickSlip, Bdf2FindsTheSameEvents)
{
  const Rubbing &r        = GetParam();
  Machine        machine  = rubbing_mass(r);
  const auto     expected = event_times("order/d_coulomb_events.csv", r.name);
  const auto     found =
      times(events_of_run(machine, bdf(2, 1e-4), Vector::Constant(1, r.x0), Vector::Constant(1, r.v0), r.end));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-4 * r.end) << i; // the phase of BDF2 lags by (omega h)^2/3 = 3e-7
}

TEST_P(StickSlip, ControlledBdfFindsTheSameEvents)
{
  const Rubbing &r        = GetParam();
  Machine        machine  = rubbing_mass(r);
  const auto     expected = event_times("order/d_coulomb_events.csv", r.name);
  // A slip begins with u' = 0: an error of the tolerance there may stick and slip once more, nanoseconds later.
  const auto found = times(events_of_run(machine, tests::controlled(bdf(5, 1e-2), 1e-9), Vector::Constant(1, r.x0),
                                         Vector::Constant(1, r.v0), r.end),
                           1e-6);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-7) << i; // a hundred tolerances; measured 1e-8
}

// Wilson's method solves at t + theta h, where the load differs by up to 1e-2 N from that at t + h; the force that
// holds the mass is found anew at the end of the step. 1e-4 N is a hundredth of that difference.
TEST(Sticking, IsHeldByTheLoadOfItsInstantUnderWilsonsMethod)
{
  const Rubbing &r          = rubbing[2];
  Machine        machine    = rubbing_mass(r);
  MethodOptions  method     = tests::method("wilson", 1e-3);
  const auto     integrator = make_integrator(machine, method);
  EventDriver    driver(machine, *integrator, EventOptions());
  driver.begin(0., Vector::Constant(1, r.x0), Vector::Constant(1, r.v0));
  int n_stuck = 0;
  while (integrator->time() < r.end - 1e-12)
  {
    driver.advance();
    if (machine.forces().held().empty() || integrator->time() - integrator->step_begin() < 0.999e-3)
      continue;
    const Instant now = integrator->instant();
    EXPECT_NEAR(now.local.p[0], 100. * now.q[0] - r.F * std::cos(r.Omega * now.t), 1e-4) << now.t;
    ++n_stuck;
  }
  EXPECT_GT(n_stuck, 500);
}

INSTANTIATE_TEST_SUITE_P(Rubbing, StickSlip, ::testing::ValuesIn(rubbing),
                         [](const auto &info) { return std::string(info.param.name); });

} // namespace
} // namespace gestell::tests
