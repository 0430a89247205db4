#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/prepared_machine.h"
#include "apps/cli/results_path.h"
#include "apps/cli/stress_answer.h"
#include "apps/output/result_folder.h"
#include "coupling/simulation/simulation.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace gestell::apps
{

namespace
{
std::string settings_text(const Scene &scene)
{
  const coupling::RunOptions    &run    = scene.run.options;
  const coupling::MethodOptions &method = run.method;
  std::ostringstream             text;
  text << coupling::method_name(method) << ", ";
  if (method.tolerance > 0.)
  {
    text << "step controlled to a tolerance of " << method.tolerance;
    if (method.step > 0.)
      text << ", at most " << method.step << " s";
  }
  else
    text << "fixed step " << method.step << " s";
  text << ", from " << run.begin << " s to " << run.end << " s; "
       << (run.events ? "events located, the integration restarts at each of them"
                      : "events are gone over and told afterwards");
  return text.str();
}

/// Pictures show the companion of an unreduced frame.
void states_for_pictures(const PreparedMachine &prepared, coupling::RunResult &run)
{
  if (!prepared.companion)
    return;
  for (Eigen::VectorXd &state : run.picture_states)
    state = prepared.project(state);
}

/// The state at the begin of the run, or why there is none.
coupling::InitialState found_start(const Scene &scene, PreparedMachine &prepared, std::string &failure)
{
  try
  {
    coupling::InitialState initial = prepare_start(scene, prepared);
    require_free_motion(scene, prepared.machine, initial);
    return initial;
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
  result.method  = coupling::method_name(run.method);
  result.failure = "the machine does not start: " + failure;
  return result;
}

void print_answer(const coupling::RunResult &run)
{
  std::cout << std::left << std::setw(12) << "signal" << std::right << std::setw(16) << "min" << std::setw(14)
            << "at t [s]" << std::setw(16) << "max" << std::setw(14) << "at t [s]" << '\n';
  for (const coupling::SignalSummary &signal : run.signals)
    std::cout << std::left << std::setw(12) << signal.name << std::right << std::setprecision(7) << std::setw(16)
              << signal.min << std::setw(14) << signal.t_min << std::setw(16) << signal.max << std::setw(14)
              << signal.t_max << "  " << signal.unit << '\n';
  std::cout << run.method << ": " << run.events.size() << " events, " << run.work.steps << " steps, "
            << std::setprecision(3) << double(run.work.newton) / std::max(1L, run.work.steps)
            << " Newton iterations a step, " << run.work.factorisations << " factorisations, " << run.wall_s << " s\n";
  const coupling::EnergySummary &energy = run.energy;
  if (energy.exchanged > 0. || energy.residual > 0.) // else the balance was not kept
    std::cout << "energy residual " << energy.residual << " J of " << energy.exchanged << " J exchanged, "
              << energy.input << " J supplied\n";
}

int run_scene(const CommonOptions &options)
{
  const Scene scene = read_scene(options.input, options.overrides, options.scripts);
  require_run(scene);
  check_scene(scene);
  const std::filesystem::path folder = results_path(options, scene);
  require_writable(folder);

  ProgressLine    progress(options.quiet);
  PreparedMachine prepared = prepare_machine(scene, progress);
  require_stress(scene, prepared.machine.reduced_frame());
  const auto signals = scene_signals(scene, prepared.machine);
  progress.show("start");
  std::string                  failure;
  const coupling::InitialState initial = found_start(scene, prepared, failure);
  progress.show("modes");
  Result result   = begin_result(scene, "run", prepared);
  result.settings = settings_text(scene);
  result.asked    = {options.input, options.overrides, scene.run.options};

  const coupling::RunOptions &run = scene.run.options;
  progress.show("integration", 0.);
  const auto tell = [&](double t) { progress.show("integration", (t - run.begin) / (run.end - run.begin)); };
  if (failure.empty())
    try
    {
      result.run = coupling::simulate(prepared.machine, initial, run, signals, tell, &interruption());
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(scene.run.place + ": " + error.what());
    }
  else
    result.run = not_started(run, failure);
  progress.show("results");
  states_for_pictures(prepared, *result.run);
  if (scene.stress.given && !result.run->rows.empty())
    result.stress = stress_answer(scene, *prepared.machine.reduced_frame(), *result.run, result.warnings);
  prepare_folder(folder);
  progress.done();
  result.wall_s = progress.wall_seconds();
  write_results(folder, result);

  print_answer(*result.run);
  if (!result.model.damping.empty())
    std::cout << "damping of the frame: " << result.model.damping << '\n';
  for (const auto *warnings : {&result.warnings, &result.run->warnings})
    for (const std::string &warning : *warnings)
      std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << "report: " << (folder / "report.html").string() << '\n';
  if (!result.run->failure.empty())
  {
    std::cerr << "gestell: the computation failed: " << result.run->failure << "\n  what was computed up to then is in "
              << folder.string() << '\n';
    return exit_failed;
  }
  return result.run->interrupted ? exit_interrupted : exit_done;
}

} // namespace

Command run_command()
{
  return {"run",
          "simulate a scene in time",
          {"gestell run apps/scenes/press.toml -o results/press"},
          CommandInput::scene,
          {},
          run_scene};
}

} // namespace gestell::apps
