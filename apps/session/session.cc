#include "apps/session/session.h"

#include "apps/output/text/settings_text.h"
#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/damping_text.h"
#include "apps/scene/build/result_window.h"
#include "apps/session/joint_opening.h"
#include "apps/session/main_peak.h"
#include "apps/session/repeating_machine.h"
#include "apps/session/run_magnitudes.h"
#include "apps/session/story/dense_pictures.h"
#include "apps/session/story/swing_shares.h"
#include "apps/session/stress_answer.h"
#include "coupling/periodic/period_flow.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// Moves the state onto the periodic motion to which it leads.
void go_on_orbit(const Scene &scene, PreparedMachine &prepared, const std::atomic<bool> *stop,
                 coupling::InitialState &state)
{
  const RepeatingMachine repeating = repeating_machine(scene, prepared.machine, state, {}, stop);
  const ChosenMethod     chosen    = chosen_method(repeating, "");
  const auto             options   = periodic_options(scene, {}, prepared.machine);
  const auto             found     = chosen.method->solve(repeating.problem, repeating.guess, options);
  const auto             solution  = std::find_if(found.begin(), found.end(), [](const auto &s) { return s.stable(); });
  if (solution == found.end())
    throw coupling::ConvergenceFailure("start.rule = \"periodic\": the periodic solutions found are unstable");
  state.q       = solution->q;
  state.v       = solution->v;
  state.settled = true;
  state.still   = coupling::still_speed(prepared.machine, state.q, state.v, solution->period);
}

/// The state at the start of the run, or the reason why there is none.
coupling::InitialState found_start(const Scene &scene, PreparedMachine &prepared, const std::atomic<bool> *stop,
                                   std::string &failure)
{
  try
  {
    coupling::InitialState initial = prepare_start(scene, prepared);
    require_free_motion(scene, prepared.machine, initial);
    if (scene.start.periodic)
      go_on_orbit(scene, prepared, stop, initial);
    return initial;
  }
  catch (const coupling::NoPeriodicMotion &none)
  {
    failure = std::string("start.rule = \"periodic\": ") + none.what();
    return {};
  }
  catch (const coupling::ConvergenceFailure &none)
  {
    failure = none.what();
    return {};
  }
}

coupling::RunResult not_started(const coupling::RunOptions &run, const std::string &failure)
{
  coupling::RunResult result;
  result.method = coupling::method_name(run.method);
  result.stop("no-start", "", "no initial state: " + failure);
  return result;
}

} // namespace

Session::Session(const std::string &path, const std::vector<std::string> &overrides, fem::Scripts scripts,
                 const Watch &watch)
    : Session(Variant::of_file(path, overrides, scripts), watch)
{
}

Session::Session(Variant variant, const Watch &watch)
    : variant_(std::move(variant)), scene_(variant_.scene()), watch_(watch)
{
}

Session::Session(Variant variant, Scene scene, const Watch &watch)
    : variant_(std::move(variant)), scene_(std::move(scene)), watch_(watch)
{
}

std::unique_ptr<Session> Session::beside(const std::string &file) const
{
  // Not a copy: the callback may have a state, as one that knows whether there is something to save.
  const Watch same{[this](const std::string &phase, double share) { tell(watch_.progress, phase, share); },
                   watch_.interruption};
  return std::make_unique<Session>(file, std::vector<std::string>(), variant_.scripts, same);
}

void Session::check()
{
  if (!checked_)
    check_scene(scene_);
  checked_ = true;
}

void Session::check_run()
{
  require_run(scene_);
  check();
}

coupling::Progress Session::progress()
{
  return [this](const std::string &phase, double share)
  {
    times_.begin(phase);
    tell(watch_.progress, phase, share);
  };
}

PreparedMachine &Session::machine()
{
  check();
  if (!machine_)
  {
    machine_ = std::make_shared<PreparedMachine>(prepare_machine(scene_, stoppable(progress(), watch_.interruption)));
    keep_stable_step(*machine_, scene_.run);
  }
  return *machine_;
}

void Session::vary(const std::string &change)
{
  variant_ = variant_.with(change);
  scene_   = variant_.scene();
  machine_.reset();
  checked_ = false;
}

void Session::use_frame(const coupling::ReducedFrame &frame)
{
  machine_ = std::make_shared<PreparedMachine>(prepare_machine(scene_, {}, &frame));
}

FrameAnswer Session::reduced_frame()
{
  check();
  FrameAnswer answer{apps::reduced_frame(scene_, stoppable(progress(), watch_.interruption)), {}};
  answer.facts.frame        = answer.frame.facts;
  answer.facts.frame_mass   = answer.frame.mass;
  answer.facts.free_motions = static_cast<int>((answer.frame.frequencies_hz.array() == 0.).count());
  answer.facts.damping      = damping_text(scene_.frame);
  answer.facts.mesh         = mesh_text(scene_.frame);
  answer.facts.statements   = answer.frame.statements;
  times_.end();
  return answer;
}

Partition Session::partition()
{
  const PreparedMachine &prepared = machine();
  return partition_of(scene_, prepared.machine, scene_signals(scene_, prepared.machine));
}

Result Session::answered(const std::string &command, const std::function<void(Result &)> &add,
                         coupling::GeometricStiffness geometric)
{
  PreparedMachine &prepared = machine();
  progress()("modes", -1.);
  Result result    = begin_result(scene_, command, prepared, geometric);
  result.requested = {variant_.path, variant_.changes, std::nullopt, geometric};
  add(result);
  return finished(std::move(result));
}

Result Session::modes(coupling::GeometricStiffness geometric)
{
  return answered(
      "modes", [](Result &) {}, geometric);
}

Result Session::run(const RunParts &parts)
{
  check_run();
  PreparedMachine &prepared = machine();
  require_stress(scene_, prepared.machine.model().reduced_frame());
  const auto signals = with_normal_forces(scene_, prepared.machine, scene_signals(scene_, prepared.machine));
  progress()("start", -1.);
  std::string                  failure;
  const coupling::InitialState initial = found_start(scene_, prepared, watch_.interruption, failure);
  progress()("modes", -1.);
  scene_.run.options.from = result_window(scene_, prepared.machine, initial);
  Result result           = begin_result(scene_, "run", prepared);
  result.settings         = settings_text(scene_.run.options);
  result.requested = {variant_.path, variant_.changes, scene_.run.options, coupling::GeometricStiffness::included};
  RunInProgress in_progress{*this, signals, result};
  for (RunPart *part : parts)
    part->before_motion(in_progress);
  const bool followed =
      std::any_of(parts.begin(), parts.end(), [](const RunPart *part) { return !part->needs_trajectory().empty(); });
  result.run = failure.empty()
                   ? simulated(initial, signals, followed ? &in_progress.trajectory : nullptr, result.warnings)
                   : not_started(scene_.run.options, failure);
  progress()("results", -1.);
  for (RunPart *part : parts)
    part->after_motion(in_progress);
  progress()("results", -1.);
  for (std::string &opening : opening_joints(scene_, signals, *result.run))
    result.warnings.push_back(std::move(opening));
  result.peak = taken_peak(signals, *result.run);
  if (result.peak)
    add_dense_pictures(*result.run, *result.peak);
  prepared.project_pictures(*result.run);
  if (result.peak && prepared.companion)
    result.peak->q = prepared.project(result.peak->q);
  if (scene_.stress.given && !result.run->rows.empty())
    result.stress = stress_answer(scene_, *prepared.machine.model().reduced_frame(), *result.run, result.warnings);
  return finished(std::move(result));
}

coupling::RunResult Session::simulated(const coupling::InitialState        &initial,
                                       const std::vector<coupling::Signal> &signals, coupling::Trajectory *trajectory,
                                       std::vector<std::string> &warnings)
{
  coupling::RunOptions run = scene_.run.options;
  ask_for_peak(signals, run.states);
  if (swings_ && run.picture_step > 0.)
    run.states.around = swing_extremes(signals, machine_->machine.size());
  RunMagnitudes magnitudes(scene_, machine_->machine, machine_->small());
  const auto share = [&, now = progress()](double t) { now("integration", (t - run.begin) / (run.end - run.begin)); };
  share(run.begin);
  std::optional<coupling::RunCheckpoints> checkpoints;
  std::vector<std::string>                not_kept;
  if (checkpoints_)
    checkpoints = run_checkpoints(*checkpoints_, variant_.root, machine_->machine, initial, not_kept);
  try
  {
    coupling::RunResult result =
        coupling::simulate(machine_->machine, initial, run, signals, share, watch_.interruption, trajectory,
                           checkpoints ? &*checkpoints : nullptr, &magnitudes.signals());
    for (std::string &warning : not_kept)
      result.warn("checkpoint", "", std::move(warning));
    check_window(scene_, machine_->machine, initial, result);
    warn_of_magnitudes(magnitudes.unexpected(result), warnings);
    return result;
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(scene_.run.place + ": " + error.what());
  }
}

Result Session::finished(Result result)
{
  times_.end();
  result.wall_s = times_.seconds();
  if (result.scenery.forces)
    result.scenery.forces = [machine = machine_, forces = std::move(result.scenery.forces)](const auto &...state)
    { return forces(state...); };
  return result;
}

} // namespace gestell::apps
