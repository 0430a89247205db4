// Stages of a run and what rings in the last one: against closed solutions and the planar crane.

#include "apps/analysis/analyses.h"
#include "apps/analysis/stages/stage_result.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Session;

TEST(LiftOff, IntervalsAreBetweenTheEventsOfAWheel)
{
  coupling::RunResult run;
  run.events           = {{1., "left", "lift_off"},
                          {1.5, "right", "touch_down"},
                          {2., "left", "touch_down"},
                          {2.5, "limiter", "switch"},
                          {3., "left", "lift_off"}};
  const auto intervals = apps::lift_off_intervals(run, 0., 4.);
  ASSERT_EQ(intervals.size(), 3u);
  const auto expect = [&](std::size_t i, const std::string &wheel, double begin, double end)
  {
    EXPECT_EQ(intervals[i].wheel, wheel);
    EXPECT_EQ(intervals[i].begin, begin);
    EXPECT_EQ(intervals[i].end, end);
  };
  expect(0, "left", 1., 2.);
  expect(1, "right", 0., 1.5); // began in the air
  expect(2, "left", 3., 4.);   // does not come down
}

// --- the planar crane, with a step that leaves 0.1 ms of its event times

std::vector<std::string> crane(const std::vector<std::string> &more = {})
{
  std::vector<std::string> settings = {
      "run.step=\"1 ms\"", "output.stages={borders=[\"limiter\", \"cylinder.braking_ends\"], "
                           "names=[\"luffing\", \"braking\", \"ringing\"], ringing=[\"q2\", \"q3\", \"F_v\"]}"};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

apps::Result crane_run(const std::vector<std::string> &more = {}, const std::string &file = "crane_minimal.toml")
{
  Session session(shipped(file), crane(more));
  return apps::run_with(apps::analyses_of("run"), session);
}

const apps::StageResult &stages_of(const apps::Result &result)
{
  const auto *found = apps::answer_in<apps::StageResult>(result.answers);
  return found ? *found : throw std::runtime_error("no stages");
}

TEST(Stages, OfTheCraneLieBetweenLimiterAndStandstill)
{
  const apps::Result result = crane_run();
  const auto        &stages = stages_of(result).stages;
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_NEAR(stages[0].end, 2.650085, 1e-4);
  EXPECT_NEAR(stages[1].end - stages[1].begin, 0.15, 1e-12);
  EXPECT_EQ(stages[2].end, 10.);
  EXPECT_TRUE(stages_of(result).lift_offs.empty());
  // the pendulum beside that of the reference, linearised at rest: damped frequency [Hz] and damping ratio
  ASSERT_FALSE(stages_of(result).ringing.modes.empty());
  const auto &pendulum = stages_of(result).ringing.modes.front();
  ASSERT_TRUE(pendulum.linearised);
  EXPECT_NEAR(pendulum.linearised->frequency_hz, 0.404116784280382, 1e-6);
  EXPECT_NEAR(pendulum.linearised->damping_ratio, 0.0040894005004324, 1e-6);
  EXPECT_NEAR(pendulum.frequency_hz, pendulum.linearised->frequency_hz, 0.005 * pendulum.linearised->frequency_hz);
}

/// The mode found nearest to the linearised one of that frequency.
const apps::RingingMode &mode_near(const apps::Result &result, double frequency_hz)
{
  const auto &modes = stages_of(result).ringing.modes;
  return *std::min_element(modes.begin(), modes.end(),
                           [&](const auto &a, const auto &b) {
                             return std::abs(a.frequency_hz - frequency_hz) < std::abs(b.frequency_hz - frequency_hz);
                           });
}

// Braked softly the load swings by 0.03 rad, whose square over 16 is 6e-5 of its frequency.
TEST(Stages, OfASoftlyBrakedCraneRingInItsLinearisedModes)
{
  const apps::Result result =
      crane_run({"joint.cylinder.motion.brake.duration=\"2 s\"", "run.end=\"14 s\"", "output.stages.modes=5"});
  for (const double expected : {0.407, 1.2}) // pendulum and pitch, further out than in the reference
  {
    const auto &mode = mode_near(result, expected);
    EXPECT_EQ(mode.combination, "");
    ASSERT_TRUE(mode.linearised);
    EXPECT_NEAR(mode.frequency_hz, mode.linearised->frequency_hz, 2e-3 * mode.linearised->frequency_hz);
    EXPECT_NEAR(mode.damping_ratio, mode.linearised->damping_ratio, 0.05 * mode.linearised->damping_ratio);
  }
}

TEST(Stages, OfTyresThatLiftOffRingAfterTheLastTouchDown)
{
  const apps::Result result = crane_run({}, "crane_minimal_lift.toml");
  ASSERT_EQ(stages_of(result).lift_offs.size(), 3u);
  EXPECT_NEAR(stages_of(result).lift_offs[0].begin, 2.823789, 1e-3);
  EXPECT_NEAR(stages_of(result).lift_offs[0].end, 3.310023, 1e-3);
  EXPECT_EQ(stages_of(result).ringing.begin, stages_of(result).lift_offs[2].end);
}

TEST(Stages, ReportHowFarALimitWasMissed)
{
  const apps::Result result = crane_run({"switch.limiter.above=\"900 kN\"", "run.end=\"1 s\""});
  for (const char *words :
       {"did not reach the stage boundary 'limiter'", "cylinder.force reaches 2", "its switch needs 9e+05"})
    EXPECT_THAT(result.run->failure, ::testing::HasSubstr(words));
  EXPECT_GT(result.run->rows.size(), 0u); // kept
}

TEST(Stages, DoNotBeginBeyondTheirLimit)
{
  const apps::Result result = crane_run({"switch.limiter.above=\"100 kN\"", "run.end=\"1 s\""});
  EXPECT_THAT(result.run->failure, ::testing::HasSubstr("the stage 'luffing' is empty"));
}

TEST(Stages, NeedNamesAndSignalsThatThereAre)
{
  const auto refused = [](const std::string &stages)
  { return refusal([&] { apps::read_scene(shipped("crane_minimal.toml"), {"output.stages=" + stages}); }); };
  EXPECT_THAT(refused("{borders=[\"limiter\"], names=[\"a\"]}"), ::testing::HasSubstr("1 border for 2"));
  EXPECT_THAT(refused("{borders=[\"limiter\"], ringing=[\"q9\"]}"), ::testing::HasSubstr("no signal 'q9'"));
  EXPECT_THAT(refused("{borders=[]}"), ::testing::HasSubstr("needs at least one string"));
}

// --- a switch that ends the run

TEST(Switches, EndTheRunWithTheirStatement)
{
  const std::vector<std::string> tips = {
      "switch.tips={when=\"chassis.angle\", below=\"-0.02 rad\", ends=\"the crane tips over its front axle\"}"};
  const apps::Result result = crane_run(tips);
  EXPECT_THAT(result.run->failure, ::testing::HasSubstr("the crane tips over its front axle: chassis.angle is below"));
  EXPECT_EQ(result.run->events.back().name, "tips");
  const auto &rows = result.run->rows;
  EXPECT_NEAR(rows[rows.size() - result.run->columns.size()], result.run->events.back().t, 1e-12); // the last row
}

TEST(Switches, EndARunThatBeginsBeyondThem)
{
  const apps::Result result =
      crane_run({"switch.tips={when=\"chassis.angle\", below=\"0.1 rad\", ends=\"the crane tips over\"}"});
  EXPECT_THAT(result.run->failure, ::testing::HasSubstr("at the start, t = 0 s, the crane tips over"));
}

// --- entries that are not inherited

TEST(Scenes, LeaveOutWhatTheyDoNotWantOfAnother)
{
  const test::SceneFolder folder;
  const std::string       base    = shipped("crane_minimal.toml");
  const auto              without = [&](const std::string &list)
  { return folder.write("own.toml", "extends = \"" + base + "\"\nwithout = " + list + "\n"); };
  EXPECT_EQ(apps::read_scene(without("[\"element.air\"]")).elements.size() + 1,
            apps::read_scene(base, {}).elements.size());
  expect_refusal([&] { apps::read_scene(without("[\"element.ari\"]")); }, "did you mean 'element.air'");
  expect_refusal([&] { apps::read_scene(folder.write("alone.toml", "without = [\"element.air\"]")); },
                 "there is no 'extends'");
}

} // namespace
} // namespace gestell::tests
