#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/tables/budget_table.h"
#include "apps/output/tables/comparison_table.h"
#include "apps/output/tables/noise.h"
#include "apps/output/tables/sensitivity_table.h"
#include "apps/output/tables/stage_table.h"
#include "apps/output/tables/story_table.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/comparison/scene_comparison.h"
#include "apps/session/session.h"
#include "apps/session/story/run_facts.h"
#include "apps/sizing/error_budget.h"
#include "coupling/frame/atomic_file.h"
#include "fem/values/shell_word.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
void print_answer(const coupling::RunResult &run)
{
  std::cout << std::left << std::setw(12) << "signal" << std::right << std::setw(16) << "min" << std::setw(14)
            << "at t [s]" << std::setw(16) << "max" << std::setw(14) << "at t [s]" << '\n';
  const Noise noise = noise_of(run.signals);
  if (!run.rows.empty() && run.from > run.rows.front())
    std::cout << "(from " << run.from << " s on)\n";
  for (const coupling::SignalSummary &signal : run.signals)
    std::cout << std::left << std::setw(12) << signal.name << std::right << std::setprecision(7) << std::setw(16)
              << noise.without(signal.unit, signal.min) << std::setw(14) << signal.t_min << std::setw(16)
              << noise.without(signal.unit, signal.max) << std::setw(14) << signal.t_max << "  " << signal.unit << '\n';
  std::cout << run.method << ": " << run.events.size() << " events, " << run.work.steps << " steps, "
            << std::setprecision(3) << double(run.work.newton) / std::max(1L, run.work.steps)
            << " Newton iterations a step, " << run.work.factorisations << " factorisations, " << run.wall_s << " s\n";
  const coupling::EnergySummary &energy = run.energy;
  if (energy.exchanged > 0. || energy.residual > 0.) // else the balance was not kept
    std::cout << "energy residual " << energy.residual << " J of " << energy.exchanged << " J exchanged, "
              << energy.input << " J supplied\n";
}

const char *const checkpoint_name = "checkpoint.bin";

struct RunCommand
{
  bool        resume     = false;
  double      checkpoint = 30.; ///< [s] of wall time
  bool        budget     = false;
  std::string outputs;
  std::string sensitivities;
  std::string compare; ///< file of another scene; empty: none
};

/// What stops a budget leaves the run that it is of.
void add_budget(const Scene &scene, const std::vector<OutputName> &outputs, Result &result)
{
  try
  {
    result.budget = error_budget(scene, outputs, answer_of(result, outputs), &interruption());
  }
  catch (const std::runtime_error &failure)
  {
    result.warnings.push_back("there is no error budget: " + std::string(failure.what()));
  }
}

/// A checkpoint that the run goes on from is ours wherever it came from: it was read as that of this run.
void claim_checkpoint(const std::filesystem::path &folder, bool resumed)
{
  OwnFolder own(folder);
  if (resumed)
    own.adopt(checkpoint_name);
  else
    own.claim(checkpoint_name);
}

void remove_checkpoint(const std::filesystem::path &folder, bool resumed)
{
  if (resumed)
    claim_checkpoint(folder, resumed);
  OwnFolder(folder).remove(checkpoint_name);
}

/// Derivatives follow the whole motion, which is not kept.
void keep_checkpoints(const RunCommand &requested, const std::filesystem::path &folder, Session &session)
{
  if (requested.sensitivities.empty())
    session.keep_checkpoints({folder / checkpoint_name, requested.checkpoint, requested.resume,
                              [folder, resumed = requested.resume] { claim_checkpoint(folder, resumed); }});
  else if (requested.resume)
    throw std::invalid_argument("--resume: a run with --sensitivities cannot go on from a checkpoint, as derivatives "
                                "follow its whole motion; leave out one of the two");
}

/// The command that goes on, as it is typed.
std::string resuming(const CommonOptions &options, const std::filesystem::path &folder)
{
  std::string command = "gestell run " + fem::typed_word(options.input);
  for (const std::string &entry : options.overrides)
    command += " --set " + fem::typed_word(entry);
  if (options.scripts == fem::Scripts::trusted)
    command += " --trust-scripts";
  return command + " --resume -o " + fem::typed_word(folder.string());
}

/// Of an interrupted run a failure tells, too, whether it can go on.
/// @param resuming  the command; "" for a run that keeps no checkpoints
void write_answer(const std::filesystem::path &folder, const Result &result, const std::string &resuming)
{
  try
  {
    write_results(folder, result);
  }
  catch (const coupling::WriteFailure &failure)
  {
    if (!result.run->interrupted || resuming.empty())
      throw;
    throw coupling::WriteFailure(std::string(failure.what()) +
                                 (std::filesystem::exists(folder / checkpoint_name)
                                      ? "\n  the run was interrupted; " + resuming + " goes on from its last checkpoint"
                                      : "\n  the run was interrupted, and no checkpoint could be kept: it cannot go on "
                                        "from there"));
  }
}

int run_scene(const CommonOptions &options, const RunCommand &requested)
{
  ProgressLine progress(options.quiet);
  if (!(requested.checkpoint >= 0.) || !std::isfinite(requested.checkpoint))
    throw std::invalid_argument("--checkpoint: needs a plain number of seconds, zero or above, got " +
                                std::to_string(requested.checkpoint));
  const auto on_progress = nothing_to_save_before("integration", progress.callback());
  Session    session(options.input, options.overrides, options.scripts, {on_progress, &interruption()});
  session.check_run();
  std::vector<OutputName> outputs;
  if (requested.budget)
    outputs = budget_outputs(session.scene(), requested.outputs);
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options, {requested.compare});
  require_room(folder, {requested.resume ? "" : checkpoint_name}, inputs);
  std::optional<Session> other;
  if (!requested.compare.empty())
    require_comparable_runs(session, other.emplace(requested.compare, std::vector<std::string>(), options.scripts,
                                                   Watch{progress.callback(), &interruption()}));
  session.keep_swings();
  keep_checkpoints(requested, folder, session);
  Result result = requested.sensitivities.empty() ? session.run() : session.run(requested.sensitivities);
  add_story(session, result);
  if (other && !result.run->interrupted)
    add_compared_run(session, result, *other);
  if (requested.budget && result.run->failure.empty() && !result.run->interrupted)
    add_budget(session.scene(), outputs, result);
  prepare_folder(folder, inputs);
  progress.done();
  write_answer(folder, result, requested.sensitivities.empty() ? resuming(options, folder) : "");
  if (!result.run->interrupted)
    remove_checkpoint(folder, requested.resume);

  if (answers_in_json())
    answer_with(summary_json(result));
  print_answer(*result.run);
  if (result.stages)
    std::cout << stages_text(*result.stages);
  if (result.story)
    std::cout << story_text(*result.story);
  if (result.compared_run)
    std::cout << compared_run_text(*result.run, *result.compared_run);
  if (result.compared_shapes)
    std::cout << compared_modes_text(*result.compared_shapes);
  if (result.budget)
    std::cout << budget_text(*result.budget);
  if (result.sensitivities && result.sensitivities->failure.empty())
    std::cout << sensitivities_text(*result.sensitivities);
  if (!result.model.damping.empty())
    std::cout << "damping of the frame: " << result.model.damping << '\n';
  for (const auto &warnings : {result.warnings, coupling::texts_of(result.run->findings)})
    for (const std::string &warning : warnings)
      if (warning != result.run->failure)
        std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << "report: " << (folder / "report.html").string() << '\n';
  if (!result.run->failure.empty())
  {
    std::cerr << "gestell: the computation failed: " << result.run->failure << "\n  what was computed up to then is in "
              << folder.string() << '\n';
    return exit_failed;
  }
  if (result.sensitivities && !result.sensitivities->failure.empty())
  {
    std::cerr << "gestell: the run has no sensitivities: " << result.sensitivities->failure
              << "\n  the run itself is in " << folder.string() << '\n';
    return exit_failed;
  }
  if (requested.budget && !result.budget && result.run->failure.empty())
    return interruption() ? exit_interrupted : exit_failed;
  if (result.run->interrupted && requested.sensitivities.empty() && std::filesystem::exists(folder / checkpoint_name))
    std::cerr << "gestell: interrupted; " << resuming(options, folder) << " goes on from there\n";
  const bool interrupted = result.run->interrupted || (result.sensitivities && result.sensitivities->interrupted);
  return interrupted ? exit_interrupted : exit_done;
}

} // namespace

Command run_command()
{
  const auto requested = std::make_shared<RunCommand>();
  return {
      "run",
      "simulate a scene in time",
      {"gestell run apps/scenes/press.toml -o results/press",
       "gestell run apps/scenes/press_minimal.toml --compare apps/scenes/press_minimal_light.toml"},
      CommandInput::scene,
      {CommandOption{"--compare", &requested->compare,
                     "another scene, which runs as it stands in its file: its signals in the same charts, extremes "
                     "and modes beside each other"}
           .existing_file(),
       {"--resume", &requested->resume,
        "go on from the checkpoint that a run of the same scene left in its folder when it was stopped"},
       {"--checkpoint", &requested->checkpoint,
        "seconds between two checkpoints (default 30; more where they would take more than half a per cent of the "
        "time), 0: when interrupted alone"},
       {"--budget", &requested->budget,
        "tell the errors that mesh, reduction and integration leave in the outputs, by a second model for each"},
       {"--outputs",
        &requested->outputs,
        "of the budget, such as F.max,F.min,x.t_max,modes.2 (default: largest and smallest value of every signal)",
        {},
        {},
        "--budget"},
       {"--sensitivities", &requested->sensitivities,
        "derivatives of peaks, instants, events, final values and frequencies by these entries of the scene, such as "
        "parameters.c_P,parameters.s_cl, or all (every number of [parameters])"}},
      [requested](const CommonOptions &options) { return run_scene(options, *requested); }};
}

} // namespace gestell::apps
