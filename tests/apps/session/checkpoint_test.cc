// A run that goes on from its stored state ends as one that was never stopped: integrators, events, history of the
// elements, extremes, energy and counts are all in the state.

#include "apps/scene/scene.h"
#include "apps/session/checkpoint/checkpoint_file.h"
#include "apps/session/checkpoint/run_checkpoints.h"
#include "apps/session/session.h"
#include "coupling/simulation/resumable_run.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

#include <atomic>

namespace
{

using namespace gestell;
using testing::HasSubstr;

struct RunCase
{
  std::string              name, scene;
  std::vector<std::string> overrides;
};

void PrintTo(const RunCase &one, std::ostream *out)
{
  *out << one.name;
}

/// A run whose machine is made anew for every part of it, as another process would make it.
class StoppedRun
{
public:
  explicit StoppedRun(const RunCase &one)
      : scene_(apps::read_scene(std::string(GESTELL_SOURCE_DIR "/apps/scenes/") + one.scene, one.overrides))
  {
  }

  /// To the end, or to the first step after `pauses` calls of its progress.
  coupling::RunResult part(long pauses)
  {
    apps::PreparedMachine        prepared = apps::prepare_machine(scene_, {});
    const coupling::InitialState start    = apps::prepare_start(scene_, prepared);
    std::atomic<bool>            stop     = pauses == 0;
    const auto                   progress = [&](double) { stop = --pauses == 0; };
    coupling::RunCheckpoints     checkpoints;
    checkpoints.from             = state_;
    checkpoints.keep             = [this](const std::string &state) { state_ = state; };
    checkpoints.every            = 0.;
    coupling::RunOptions options = scene_.run.options;
    options.picture_step         = (options.end - options.begin) / 50.;
    for (const bool largest : {true, false}) // as the report asks for them
      options.states.around.push_back({0, largest});
    options.states.extremes = options.states.around;
    return coupling::simulate(prepared.machine, start, options, apps::scene_signals(scene_, prepared.machine), progress,
                              &stop, nullptr, &checkpoints);
  }

  void begin_anew() { state_.clear(); }

private:
  apps::Scene scene_;
  std::string state_;
};

void expect_same(const std::vector<coupling::KeptState> &run, const std::vector<coupling::KeptState> &whole)
{
  ASSERT_EQ(run.size(), whole.size());
  for (std::size_t i = 0; i < run.size(); ++i)
  {
    EXPECT_EQ(run[i].t, whole[i].t);
    EXPECT_EQ(run[i].q, whole[i].q);
    EXPECT_EQ(run[i].v, whole[i].v);
    EXPECT_EQ(run[i].p, whole[i].p);
  }
}

void expect_same(const coupling::RunResult &run, const coupling::RunResult &whole)
{
  EXPECT_EQ(run.rows, whole.rows);
  EXPECT_EQ(run.end_state, whole.end_state);
  ASSERT_EQ(run.events.size(), whole.events.size());
  for (std::size_t i = 0; i < run.events.size(); ++i)
  {
    EXPECT_EQ(run.events[i].t, whole.events[i].t);
    EXPECT_EQ(run.events[i].name + run.events[i].kind, whole.events[i].name + whole.events[i].kind);
  }
  for (std::size_t j = 0; j < run.signals.size(); ++j)
  {
    EXPECT_EQ(run.signals[j].max, whole.signals[j].max) << run.signals[j].name;
    EXPECT_EQ(run.signals[j].t_min, whole.signals[j].t_min) << run.signals[j].name;
  }
  EXPECT_EQ(run.energy.residual, whole.energy.residual);
  EXPECT_EQ(run.energy.dissipated, whole.energy.dissipated);
  EXPECT_EQ(run.work.steps, whole.work.steps);
  EXPECT_EQ(run.work.newton, whole.work.newton);
  EXPECT_EQ(run.work.factorisations, whole.work.factorisations);
  EXPECT_EQ(run.picture_times, whole.picture_times);
  EXPECT_EQ(run.picture_states, whole.picture_states);
  EXPECT_EQ(run.picture_velocities, whole.picture_velocities);
  EXPECT_EQ(run.picture_forces, whole.picture_forces);
  ASSERT_EQ(run.states.around.size(), whole.states.around.size());
  for (std::size_t i = 0; i < run.states.around.size(); ++i)
    expect_same(run.states.around[i], whole.states.around[i]);
  expect_same(run.states.extremes, whole.states.extremes);
  EXPECT_EQ(coupling::texts_of(run.findings), coupling::texts_of(whole.findings));
  EXPECT_EQ(run.failure, whole.failure);
}

class ResumedRun : public testing::TestWithParam<RunCase>
{
};

std::vector<RunCase> press_by_all_methods()
{
  const std::string    press = "press_minimal.toml";
  std::vector<RunCase> cases;
  const std::string    end    = "run.end=0.3";
  const auto           method = [&](const std::string &name, std::vector<std::string> overrides)
  {
    overrides.push_back(end);
    cases.push_back({name, press, overrides});
  };
  method("bdf1", {"run.order=1", "run.step=20 us"});
  method("bdf2", {"run.step=20 us"});
  method("bdf_controlled", {"run.tolerance=1e-5"});
  for (const std::string name : {"newmark", "wilson", "hht", "generalised-alpha", "central-difference"})
    method(name, {"run.method=" + name, "without=[\"run.order\"]", "run.step=20 us"});
  for (const std::string rule : {"average", "linear", "collocation"})
    method("exact_" + rule, {"run.method=exact", "run.force=" + rule, "without=[\"run.order\"]", "run.step=20 us"});
  method("exact_controlled", {"run.method=exact", "run.order=6", "run.tolerance=1e-6"});
  return cases;
}

std::string name_of(const testing::TestParamInfo<RunCase> &info)
{
  std::string name = info.param.name;
  for (char &c : name)
    if (c == '-')
      c = '_';
  return name;
}

} // namespace

/// Bitwise: the state holds all that the rest depends on.  Stopped behind each of the first steps, then behind every
/// thousandth.
TEST_P(ResumedRun, EndsAsOneThatWasNeverStopped)
{
  StoppedRun                run(GetParam());
  const coupling::RunResult whole = run.part(-1);
  ASSERT_TRUE(whole.failure.empty()) << whole.failure;
  run.begin_anew();
  coupling::RunResult part;
  for (int k = 0; k < 12; ++k)
    part = run.part(0);
  EXPECT_TRUE(part.interrupted);
  for (int k = 0; k < 60 && part.interrupted; ++k)
    part = run.part(1);
  ASSERT_FALSE(part.interrupted);
  expect_same(part, whole);
}
INSTANTIATE_TEST_SUITE_P(Press, ResumedRun, testing::ValuesIn(press_by_all_methods()), name_of);
INSTANTIATE_TEST_SUITE_P(Machines, ResumedRun,
                         testing::Values(RunCase{"play_in_a_journal", "slider_crank_journal.toml", {"run.end=0.05"}},
                                         RunCase{"emergency_stop", "press_emergency_stop.toml", {"run.end=0.4"}},
                                         RunCase{"crane", "crane_minimal.toml", {"run.end=1"}},
                                         RunCase{"geneva_drive", "geneva_drive.toml", {"run.end=0.2"}},
                                         RunCase{"cam", "cam_follower.toml", {"run.end=0.05"}},
                                         RunCase{"crane_lift", "crane_minimal_lift.toml", {"run.end=0.2"}},
                                         RunCase{"crane_elastic", "crane_minimal_elastic.toml", {"run.end=0.1"}},
                                         RunCase{"crank_press", "crank_press_joints.toml", {"run.end=0.1"}},
                                         RunCase{"double_four_bar", "double_four_bar.toml", {"run.end=0.5"}},
                                         RunCase{"offset_four_bar", "offset_four_bar.toml", {"run.end=0.5"}},
                                         RunCase{"press_light", "press_minimal_light.toml", {"run.end=0.05"}},
                                         RunCase{"press_strokes", "press_strokes.toml", {"run.end=0.1"}},
                                         RunCase{"run_up", "run_up.toml", {"run.end=0.3"}},
                                         RunCase{"windowed", "run_up.toml", {"run.end=0.3", "output.from=0.1"}},
                                         RunCase{"in_space", "spatial_crank_rocker.toml", {"run.end=0.2"}}),
                         name_of);

namespace
{

class CheckpointFile : public testing::Test
{
protected:
  std::string message(const std::vector<apps::KeyPart> &key) const
  {
    return tests::refusal([&] { apps::read_checkpoint(file, key); });
  }

  const test::SceneFolder          folder;
  const std::filesystem::path      file = std::filesystem::path(folder.write("scene.toml", "")).parent_path() / "c.bin";
  const std::vector<apps::KeyPart> key  = {{"the program", "12"}, {"the scene", "34"}};
};

} // namespace

TEST_F(CheckpointFile, GivesBackTheStateOfTheSameRunAlone)
{
  const std::string state("a\0b\nc", 5);
  EXPECT_THAT(message(key), HasSubstr("does not exist"));
  apps::write_checkpoint(file, key, state);
  EXPECT_EQ(apps::read_checkpoint(file, key), state);
  EXPECT_THAT(message({{"the program", "12"}, {"the scene", "35"}}), HasSubstr("the scene has changed since"));
  EXPECT_THAT(message({{"the program", "13"}, {"the scene", "34"}}), HasSubstr("the program has changed since"));
}

TEST_F(CheckpointFile, RefusesAStateThatIsCutOrChanged)
{
  apps::write_checkpoint(file, key, std::string(100, 'x'));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THAT(message(key), HasSubstr("is damaged"));
  std::ofstream(file) << "something else\n";
  EXPECT_THAT(message(key), HasSubstr("is not a checkpoint"));
}
