// Facts of a run with events: signals at events, modes in the extremes of forces, loads against periods, plays.

#include "apps/session/session.h"
#include "apps/session/story/load_duration.h"
#include "apps/session/story/run_facts.h"
#include "apps/session/story/turning_points.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Session;

apps::Result reported(const std::string &file, const std::vector<std::string> &overrides = {})
{
  Session session(file, overrides);
  session.keep_swings();
  apps::Result result = session.run();
  add_story(session, result);
  return result;
}

const apps::EventValue *event_of(const apps::Result &result, const std::string &object, const std::string &kind)
{
  for (const apps::EventValue &value : result.story->events)
    if (value.object == object && value.event == kind)
      return &value;
  return nullptr;
}

apps::ExtremeSwing extreme_of(const apps::Result &result, const std::string &signal, bool largest)
{
  for (const apps::ExtremeSwing &swing : result.story->extremes)
    if (swing.signal == signal && swing.largest == largest)
      return swing;
  throw std::runtime_error("no extreme of " + signal);
}

/// A force that touches from 1.0 to 1.05, rises from 1.1 to 2, stays at 8 to 3 and falls to zero at 3.4 s.
double trapezoid(double t)
{
  if (t > 1. && t < 1.05)
    return 1.;
  return t < 1.1 || t > 3.4 ? 0. : t < 2. ? 8. * (t - 1.1) / 0.9 : t < 3. ? 8. : 8. * (3.4 - t) / 0.4;
}

TEST(LoadDuration, IsThatOfATrapezoidWithABounceBeforeIt)
{
  std::vector<double> t, F;
  for (int i = 0; i <= 50000; ++i)
  {
    t.push_back(1e-4 * i);
    F.push_back(-trapezoid(t.back())); // the sign does not matter
  }
  const auto load = apps::load_duration(t, F);
  ASSERT_TRUE(load);
  EXPECT_NEAR(load->begin, 1., 3e-4);
  EXPECT_NEAR(load->peak, -8., 1e-12);
  EXPECT_NEAR(load->rise, 0.91, 3e-4);        // 0.9 of the peak at 1.91 s
  EXPECT_NEAR(load->t_fall, 3. + 0.04, 3e-4); // down to 0.9 of the peak
  EXPECT_NEAR(load->fall, 0.4, 4e-4);
  EXPECT_NEAR(load->end, 3.4 - 0.004, 3e-4);
}

TEST(LoadDuration, IsNoneOfForcesThatDoNotEndOrSwing)
{
  std::vector<double> t, steady, swings;
  for (int i = 0; i <= 100; ++i)
  {
    t.push_back(i);
    steady.push_back(5.);
    swings.push_back(std::sin(0.3 * i));
  }
  EXPECT_FALSE(apps::load_duration(t, steady));
  EXPECT_FALSE(apps::load_duration(t, swings));
  EXPECT_FALSE(apps::load_duration(t, std::vector<double>(t.size(), 0.)));
}

// A ramp that lasts one period leaves nothing, one of half a period 2/pi of a step.
TEST(LoadDuration, LeavesOfAStepWhatTheRampLeaves)
{
  EXPECT_EQ(apps::fall_factor(0.), 1.);
  EXPECT_NEAR(apps::fall_factor(0.25), 0.9003163161571, 1e-12);
  EXPECT_NEAR(apps::fall_factor(0.5), 2. / M_PI, 1e-15);
  EXPECT_NEAR(apps::fall_factor(1.), 0., 1e-15);
}

TEST(TurningPoints, LieHalfAPeriodApart)
{
  std::vector<double> t, y;
  for (int i = 0; i <= 4000; ++i)
  {
    t.push_back(1e-3 * i);
    y.push_back(std::cos(2. * M_PI * 1.6 * t.back()) + 0.02 * std::sin(500. * t.back())); // a ripple does not turn it
  }
  EXPECT_NEAR(apps::half_period_at(t, y, 1.25), 0.5 / 1.6, 0.005);
  EXPECT_EQ(apps::half_period_at({0., 1.}, {0., 1.}, 0.5), 0.);
}

const std::string bead =
    "name = \"bead\"\n" + slider_body("bead", "1 kg", "[1, 0, 0]") +
    element("stops", "clearance",
            {{"from", "bead"}, {"direction", "[1, 0, 0]"}, {"gap", "1 mm"}, {"stiffness", "10 N/mm"}}) +
    start("rule = 'given'\nq = { bead = '3 mm' }") + table("modes", {{"at", "{ bead = '3 mm' }"}}) +
    steps("20 us", "0.6 s", {{"method", "bdf"}, {"order", "2"}}) +
    "[output.signals]\nx = \"stops.displacement\"\nF = \"stops.force\"\n";

// Through a play of gap b and amplitude A the period is T_0 + 4 b/(omega (A - b)): f/f_0 = 1/(1 + 1/pi) for A = 3 b.
// The describing function, k_eq = k [1 - (2/pi) (asin s + s sqrt(1 - s^2))], s = 1/3, is 0.7 % above.
TEST(PlayEstimates, OfAnUndampedSliderAreNearItsPeriod)
{
  const test::SceneFolder folder;
  const apps::Result      result = reported(folder.write("bead.toml", bead));
  ASSERT_TRUE(result.story);
  ASSERT_GE(result.story->plays.size(), 3u);
  const double f_0 = 100. / (2. * M_PI), s = 1. / 3.;
  const double share = 1. - 2. / M_PI * (std::asin(s) + s * std::sqrt(1. - s * s));
  for (const apps::PlayEstimate &play : result.story->plays)
  {
    EXPECT_NEAR(play.closed_hz, f_0, 1e-9);
    EXPECT_NEAR(play.amplitude, 3e-3, 2e-6);
    EXPECT_NEAR(play.seen_hz, f_0 / (1. + 1. / M_PI), 2e-3);
    EXPECT_NEAR(play.stiffness_share, share, 1e-3);
    EXPECT_NEAR(play.frequency_hz, f_0 * std::sqrt(share), 0.01);
    EXPECT_EQ(play.limits, "");
  }
}

// The cutting shock of the reference: the fall takes 6.2 ms, a quarter of the periods of f2 and f3 and half of f4's.
TEST(Story, OfThePressReportsItsSnapThroughShock)
{
  const apps::Result result = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\""});
  ASSERT_TRUE(result.story);
  ASSERT_EQ(result.story->loads.size(), 1u);
  const apps::LoadDuration &load = result.story->loads.front();
  EXPECT_EQ(load.element, "sheet");
  EXPECT_NEAR(load.begin, 0.194923, 2e-4);
  ASSERT_EQ(load.modes.size(), 4u);                      // f1 is far slower than the load
  EXPECT_LT(load.modes[0].fall, 0.25);                   // f2
  EXPECT_LT(load.modes[1].fall, 0.25);                   // f3
  EXPECT_GT(load.modes[2].fall, 0.25);                   // f4
  EXPECT_GT(load.modes[2].energy, load.modes[1].energy); // it is f4, not the frame, that the sheet throws
  const auto &log = result.story->events;
  EXPECT_TRUE(std::is_sorted(log.begin(), log.end(), [](const auto &a, const auto &b) { return a.t < b.t; }));
  ASSERT_TRUE(event_of(result, "sheet", "tool_contact") && event_of(result, "rod", "conrod_open"));
  EXPECT_EQ(event_of(result, "rod", "conrod_open")->signal, "F_P");
  EXPECT_NEAR(extreme_of(result, "F_P", true).value, 1057e3, 1e3);
  EXPECT_NEAR(extreme_of(result, "F_P", false).value, -601.6e3, 1e3);
}

TEST(TurningPoints, TellBothEndsOfASwing)
{
  std::vector<double> t, y;
  for (int i = 0; i <= 4000; ++i)
  {
    t.push_back(1e-3 * i);
    y.push_back(std::cos(M_PI * t.back()) * (1. + 0.1 * t.back())); // turns about every second
  }
  const apps::Swing swing = apps::swing_at(t, y, 2.);
  EXPECT_NEAR(swing.turn, 2., 0.05);
  EXPECT_NEAR(std::abs(swing.nearby - swing.turn), 1., 0.01);
  EXPECT_NEAR(swing.half, std::abs(swing.nearby - swing.turn), 1e-12);
}

// Behind the shock the rod swings through its play: a mode that makes most of the force's change and has its period
// carries that.  Before it the rod is wound up by the tool: no mode has that period.
TEST(Extremes, AreCarriedByTheModeThatMakesThem)
{
  const apps::Result       result = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\""});
  const apps::ExtremeSwing pull   = extreme_of(result, "F_P", false);
  EXPECT_EQ(pull.mode, 3);
  EXPECT_NEAR(pull.mode_hz, 84.65, 0.05); // docs/how_to/case_press.md
  EXPECT_NEAR(pull.share, 0.86, 0.01);
  EXPECT_NEAR(pull.swing_hz, 76., 1.);
  EXPECT_THAT(pull.strain, ::testing::HasSubstr("rod"));
  const apps::ExtremeSwing torque = extreme_of(result, "M_T", true);
  EXPECT_EQ(torque.mode, 1);
  EXPECT_NEAR(torque.share, 0.91, 0.01);
  EXPECT_NEAR(torque.sum, 1., 0.05); // all modes together make it
  const apps::ExtremeSwing push = extreme_of(result, "F_P", true);
  EXPECT_GT(std::abs(std::log(push.mode_hz / push.swing_hz)), 0.25);
}

// At dead centre the crank does not feel the slide.  Wherever the scene looks for its modes, the load excites those of
// the machine as it stands at the fall, and swings are carried by those of their own instant.
TEST(Story, IsOfTheMachineWhereItHappens)
{
  const std::vector<std::string> step{"run.step=\"20 us\""};
  std::vector<std::string>       centre = step;
  centre.push_back("modes.at={}");
  const apps::Result at_fall = reported(shipped("press_minimal.toml"), step),
                     other   = reported(shipped("press_minimal.toml"), centre);
  ASSERT_EQ(other.story->loads.size(), 1u);
  const auto &modes = at_fall.story->loads[0].modes, &same = other.story->loads[0].modes;
  ASSERT_EQ(same.size(), modes.size());
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    EXPECT_EQ(same[j].frequency_hz, modes[j].frequency_hz);
    EXPECT_EQ(same[j].energy, modes[j].energy);
  }
  EXPECT_NEAR(modes[0].energy, 353., 2.); // docs/how_to/case_press.md; 0 J at dead centre
  EXPECT_NEAR(modes[1].energy, 14.7, 0.2);
  ASSERT_EQ(other.story->extremes.size(), at_fall.story->extremes.size());
  for (const auto &[signal, largest] : {std::pair("F_P", false), std::pair("M_T", true), std::pair("F_col", false)})
  {
    const apps::ExtremeSwing own = extreme_of(at_fall, signal, largest), his = extreme_of(other, signal, largest);
    EXPECT_EQ(his.mode_hz, own.mode_hz) << signal;
    EXPECT_EQ(his.share, own.share) << signal;
  }
}

// Of two modes no number is given to those that were not asked for.
TEST(Extremes, DoNotDependOnHowManyModesAreAskedFor)
{
  const apps::Result all = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\""}),
                     two = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\"", "modes.number=2"});
  EXPECT_EQ(extreme_of(two, "F_P", false).mode, -1);
  EXPECT_EQ(extreme_of(two, "F_P", false).share, extreme_of(all, "F_P", false).share);
  EXPECT_EQ(two.story->events.size(), all.story->events.size());
}

// The torque of a motor comes from its speed, forces of ideal joints from the motion as a whole.
TEST(Extremes, OfForcesThatPositionsDoNotTellHaveNoShares)
{
  const apps::Result press = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\""});
  EXPECT_NEAR(extreme_of(press, "M_mot", false).sum, 0., 1e-3);
  EXPECT_TRUE(std::isnan(extreme_of(press, "F_u", true).share)); // a law of the tool's way
  const apps::Result joints = reported(shipped("crank_press_joints.toml"));
  ASSERT_TRUE(joints.story);
  for (const apps::ExtremeSwing &swing : joints.story->extremes)
    if (std::isfinite(swing.sum))
      EXPECT_GT(std::abs(swing.sum - 1.), 0.2) << swing.signal;
}

// Twelve pictures and more to a period of the vibration that makes the main peak, few of them elsewhere.
TEST(Pictures, AreDenseAroundTheMainPeak)
{
  const std::vector<std::string> step{"run.step=\"20 us\""};
  const apps::Result             dense = reported(shipped("press_minimal.toml"), step),
                     plain             = Session(shipped("press_minimal.toml"), step).run();
  ASSERT_TRUE(dense.peak);
  ASSERT_GT(dense.peak->half_swing, 0.);
  const auto &times  = dense.run->picture_times;
  const auto  around = std::count_if(times.begin(), times.end(),
                                     [&](double t) { return std::abs(t - dense.peak->t) <= dense.peak->half_swing; });
  EXPECT_GE(around, 12);
  EXPECT_LE(times.size(), plain.run->picture_times.size() + 48);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  ASSERT_EQ(dense.run->picture_states.size(), times.size());
  ASSERT_EQ(dense.run->picture_forces.size(), times.size());
}

// Where the rod is loaded from one side only it does not swing through its play, and is not told to.
TEST(PlayEstimates, AreOfCyclesThatCrossThePlay)
{
  const apps::Result result = reported(shipped("press_minimal.toml"), {"run.step=\"20 us\""});
  ASSERT_FALSE(result.story->plays.empty());
  for (const apps::PlayEstimate &play : result.story->plays)
  {
    EXPECT_EQ(play.unit, "m");
    EXPECT_LT(play.mean - play.amplitude, -0.4e-3); // beyond the play of 0.4 mm the other side pulls
    EXPECT_GT(play.mean + play.amplitude, 0.);
  }
}

// Values at an event come from the motion there: rows a hundred times as far apart change none of them, and what they
// cannot tell is left out.
TEST(EventLog, DoesNotDependOnTheDistanceOfRows)
{
  const std::vector<std::string> step{"run.step=\"20 us\""};
  std::vector<std::string>       coarse = step;
  coarse.push_back("output.step=\"2 ms\"");
  const apps::Result close = reported(shipped("press_minimal.toml"), step),
                     far   = reported(shipped("press_minimal.toml"), coarse);
  ASSERT_TRUE(close.story && far.story);
  ASSERT_EQ(far.story->events.size(), close.story->events.size());
  int known = 0, lost = 0;
  for (std::size_t i = 0; i < far.story->events.size(); ++i)
  {
    const apps::EventValue &own = close.story->events[i], &his = far.story->events[i];
    EXPECT_EQ(his.before, own.before);
    EXPECT_EQ(his.after, own.after);
    known += std::isfinite(own.impulse) ? 1 : 0;
    lost += std::isfinite(own.impulse) && std::isnan(his.impulse) ? 1 : 0;
  }
  EXPECT_GT(known, 0);
  EXPECT_GT(lost, 0);
}

// A bead of 1 kg on a stop of 10 N/mm that it meets with v = omega A, A = 2 mm, omega = 100/s, takes from it
// 2 m v = 0.4 N s within half a period, pi/omega.
TEST(EventLog, OfABeadHasTheMomentumThatItsStopReverses)
{
  const test::SceneFolder folder;
  const apps::Result      result = reported(folder.write("bead.toml", bead));
  int                     turned = 0;
  for (const apps::EventValue &value : result.story->events)
    if (value.signal == "x" && std::isfinite(value.rate))
      EXPECT_NEAR(std::abs(value.rate), 0.2, 1e-4); // steps of 20 us: (omega h)^2 of it
    else if (value.signal == "F" && std::abs(value.impulse) > 0.1)
    {
      EXPECT_NEAR(std::abs(value.impulse), 0.4, 1e-3);
      ++turned;
    }
  EXPECT_GE(turned, 3);
}

// The motor gives in a stroke what cut and losses take: between two passages of top dead centre the stored energy is
// the same, and so is the speed.
TEST(Strokes, OfThePressSettleOnTheWorkOfTheirCut)
{
  const apps::Result result = Session(shipped("press_strokes.toml"), {"run.step=\"80 us\"", "run.end=\"7.4 s\""}).run();
  const auto        &run    = *result.run;
  const auto         column = [&](const std::string &name)
  { return std::size_t(std::find(run.columns.begin(), run.columns.end(), name) - run.columns.begin()); };
  const std::size_t width = run.columns.size(), phi = column("phi2"), speed = column("w_fly"),
                    in = column("energy input"), out = column("energy dissipated");
  std::vector<std::array<double, 2>> at_top; // motor work and what is taken [J]
  std::vector<double>                slowest{10.};
  for (std::size_t i = width; i < run.rows.size(); i += width)
  {
    const double *row = run.rows.data() + i, *last = row - width;
    slowest.back() = std::min(slowest.back(), row[speed]);
    if (std::floor(row[phi] / (2. * M_PI)) > std::floor(last[phi] / (2. * M_PI)))
    {
      at_top.push_back({row[in], row[out]});
      slowest.push_back(10.);
    }
  }
  ASSERT_GE(at_top.size(), 4u);
  const double given = at_top[3][0] - at_top[2][0], taken = at_top[3][1] - at_top[2][1];
  EXPECT_NEAR(given, taken, 1e-3 * given);
  EXPECT_NEAR(given, 5344.7, 5.); // docs/how_to/case_press.md
  EXPECT_NEAR(slowest[2], slowest[3], 1e-4 * slowest[2]);
  EXPECT_LT(slowest[2], 0.94 * 3.2188); // it falls by 7 % of its largest speed
}

} // namespace
} // namespace gestell::tests
