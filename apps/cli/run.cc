#include "apps/analysis/analyses.h"
#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/noise.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/tables/story_table.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/session.h"
#include "apps/session/story/run_facts.h"
#include "coupling/frame/atomic_file.h"
#include "fem/values/number_text.h"
#include "fem/values/shell_word.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

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
            << " Newton iterations per step, " << run.work.factorisations << " factorisations, " << run.wall_s
            << " s\n";
  const coupling::EnergySummary &energy = run.energy;
  if (energy.exchanged > 0. || energy.residual > 0.) // otherwise the balance was not computed
    std::cout << "energy residual " << energy.residual << " J of " << energy.exchanged << " J exchanged, "
              << energy.input << " J supplied\n";
}

const char *const checkpoint_name = "checkpoint.bin";

/// A checkpoint from which the run resumes is ours, whatever its origin: it was read as that of this run.
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

/// Checkpoints have no trajectory.
/// @param trajectory_for  an option that needs it; empty: none
void keep_checkpoints(const CheckpointRequest &requested, const std::filesystem::path &folder, Session &session,
                      const std::string &trajectory_for)
{
  if (trajectory_for.empty())
    session.keep_checkpoints({folder / checkpoint_name, requested.every, requested.resume,
                              [folder, resumed = requested.resume] { claim_checkpoint(folder, resumed); }});
  else if (requested.resume)
    throw std::invalid_argument(
        "--resume: a run with " + trajectory_for +
        " cannot continue from a checkpoint, because it needs the whole motion; omit one of the two options");
}

/// The command that resumes, as typed.
std::string resuming(const CommonOptions &options, const std::filesystem::path &folder)
{
  std::string command = "gestell run " + fem::typed_word(options.input);
  for (const std::string &entry : options.overrides)
    command += " --set " + fem::typed_word(entry);
  if (options.scripts == fem::Scripts::trusted)
    command += " --trust-scripts";
  return command + " --resume -o " + fem::typed_word(folder.string());
}

/// For an interrupted run the failure also shows whether it can be resumed.
/// @param resuming  the command; "" for a run without checkpoints
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
    throw coupling::WriteFailure(
        std::string(failure.what()) +
        (std::filesystem::exists(folder / checkpoint_name)
             ? "\n  the run was interrupted; " + resuming + " continues from its last checkpoint"
             : "\n  the run was interrupted without a checkpoint, so it cannot be continued"));
  }
}

int run_scene(const CommonOptions &options, const CheckpointRequest &requested, const Analyses &more)
{
  const double before = double(std::clock()) / CLOCKS_PER_SEC; // [s] CPU time: no clock tells the wall time of loading
  ProgressLine progress(options.quiet);
  if (!(requested.every >= 0.) || !std::isfinite(requested.every))
    throw std::invalid_argument("--checkpoint: needs a plain number of seconds, zero or above, got " +
                                std::to_string(requested.every));
  PhaseTimes phases;
  phases.begin("scene");
  const auto on_progress = nothing_to_save_before("integration", progress.callback());
  Session    session(options.input, options.overrides, options.scripts, {on_progress, &interruption()});
  session.check_run();
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options, files_read_by(more));
  require_room(folder, {requested.resume ? "" : checkpoint_name}, inputs);
  session.keep_swings();
  const std::string trajectory_for = needs_trajectory(more, session.scene());
  keep_checkpoints(requested, folder, session, trajectory_for);
  phases.end();
  Result result = run_with(more, session);
  result.wall_s.insert(result.wall_s.begin(), {{"program", before}, phases.seconds().front()});
  phases.begin("analyses");
  add_story(session, result);
  const AnalysisOutcome outcome = add_answers(more, session, result);
  phases.begin("earlier results");
  prepare_folder(folder, inputs);
  phases.end();
  result.wall_s.insert(result.wall_s.end(), phases.seconds().begin() + 1, phases.seconds().end());
  progress.done();
  write_answer(folder, result, trajectory_for.empty() ? resuming(options, folder) : "");
  if (!result.run->interrupted)
    remove_checkpoint(folder, requested.resume);

  if (answers_in_json())
    answer_with(summary_json(result));
  print_answer(*result.run);
  if (result.story)
    std::cout << story_text(*result.story);
  std::cout << answers_text(result);
  if (!result.model.damping.empty())
    std::cout << "damping of the frame: " << result.model.damping << '\n';
  for (const auto &warnings : {result.warnings, coupling::texts_of(result.run->findings)})
    for (const std::string &warning : warnings)
      std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << "report: " << (folder / "report.html").string() << '\n';
  if (!result.run->failure.empty())
  {
    const std::string message = (is_wanted_end(*result.run) ? "a switch ended the run: " : "the computation failed: ") +
                                result.run->failure + "\n  results up to that time are in " + folder.string();
    std::cerr << "gestell: " << message << '\n';
    error_in_json(message);
    return exit_failed;
  }
  if (outcome == AnalysisOutcome::failed)
  {
    std::cerr << "gestell: an analysis of the run failed (see the warning); the run itself is in " << folder.string()
              << '\n';
    return exit_failed;
  }
  if (result.run->interrupted && trajectory_for.empty() && std::filesystem::exists(folder / checkpoint_name))
    std::cerr << "gestell: interrupted; " << resuming(options, folder) << " continues from there\n";
  return result.run->interrupted || outcome == AnalysisOutcome::interrupted ? exit_interrupted : exit_done;
}

} // namespace

Command run_command()
{
  const auto                 requested = std::make_shared<CheckpointRequest>();
  const auto                 more      = analyses_of("run");
  std::vector<CommandOption> options   = {
        {"--resume", &requested->resume, "continue a stopped run of the same scene from the checkpoint in its folder"},
        {"--checkpoint", &requested->every,
         "seconds between two checkpoints (default 30, or more so that they take at most 0.5 % of the time); 0: only at "
           "interruption"}};
  add_options(more, options);
  return {"run",
          "simulate a scene in time",
          {"gestell run apps/scenes/press.toml -o results/press",
           "gestell run apps/scenes/press_minimal.toml --compare apps/scenes/press_minimal_light.toml"},
          CommandInput::scene,
          options,
          [requested, more](const CommonOptions &common) { return run_scene(common, *requested, more); }};
}

} // namespace gestell::apps
