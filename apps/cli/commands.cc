#include "apps/cli/commands.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/analysis.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/summary_json.h"
#include "apps/output/values/result.h"

#include <iostream>
#include <memory>

namespace gestell::apps
{
namespace
{

/// A run in the folder is kept, unless the analysis computes motions: only its addition is written.
/// @return a message about it
std::string write_answer_of(const AnalysisEntry &entry, const Result &result, const std::filesystem::path &folder,
                            const std::vector<std::filesystem::path> &inputs)
{
  if (!entry.motions.empty() || !OwnFolder(folder).owns("history.csv"))
  {
    prepare_folder(folder, inputs);
    write_results(folder, result);
    return "report: " + (folder / "report.html").string();
  }
  write_modes(folder, result);
  std::string files;
  for (const ResultFile &file : entry.files)
    if (file.by == WrittenBy::write_results)
      files += file.name + ", ";
  return folder.string() + " contains a run, which is kept: only " + files +
         "tables of modes, their charts and frame_modes.pvd were written";
}

int exit_code_of(AnalysisOutcome outcome)
{
  return outcome == AnalysisOutcome::done          ? exit_done
         : outcome == AnalysisOutcome::interrupted ? exit_interrupted
                                                   : exit_failed;
}

int compute_analysis(const AnalysisEntry &entry, Analysis &analysis, CommonOptions options)
{
  analysis.open(options.input, options.overrides, options.folder);
  ProgressLine progress(options.quiet);
  const bool   saves = !entry.motions.empty();
  Session      session(options.input, options.overrides, options.scripts,
                       {saves ? nothing_to_save_before(entry.motions, progress.callback()) : progress.callback(),
                   saves ? &interruption() : nullptr});
  session.check();
  analysis.check(session);
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options, analysis.reads());
  require_room(folder, analysis.writes(), inputs);
  if (saves)
    say_run_is_replaced(folder, entry.files.empty() ? "" : entry.files.front().name);
  AnalysisOutcome outcome = AnalysisOutcome::done;
  const Result    result  = computed(entry, analysis, session, outcome);
  progress.done();
  const std::string where = write_answer_of(entry, result, folder, inputs);
  OwnFolder         own(folder);
  const std::string more = analysis.write(session, own);
  if (answers_in_json())
    answer_with(summary_json(result));
  std::cout << answers_text(result);
  const std::string failure = outcome == AnalysisOutcome::failed ? failure_of(result) : "";
  for (const std::string &warning : all_warnings(result))
    if (warning != failure)
      std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << (more.empty() ? "" : more + '\n') << where << '\n';
  if (outcome == AnalysisOutcome::failed)
  {
    const std::string message = "the computation failed: " + failure;
    std::cerr << "gestell: " << message << '\n';
    error_in_json(message);
  }
  return exit_code_of(outcome);
}

/// The command of an analysis: checks, locks the folder of results, computes, writes, prints the results and warnings.
Command analysis_command(const AnalysisEntry &entry)
{
  const std::shared_ptr<Analysis> analysis = entry.begin();
  return {entry.name,
          entry.does,
          entry.examples,
          CommandInput::scene,
          analysis->options(),
          [&entry, analysis](const CommonOptions &options) { return compute_analysis(entry, *analysis, options); }};
}

} // namespace

Command run_command(), modes_command(), reduce_command(), check_command(), chart_command(), mesh_command(),
    stability_command(), export_command(), size_command(), study_command(), show_command(), new_command(),
    verify_command(), help_command();

std::vector<Command> commands()
{
  std::vector<Command> all = {run_command(),  modes_command(),     reduce_command(), check_command(), chart_command(),
                              mesh_command(), stability_command(), export_command(), size_command(),  study_command(),
                              show_command(), new_command(),       verify_command(), help_command()};
  for (const AnalysisEntry &entry : analyses())
    if (entry.is_command())
      all.push_back(analysis_command(entry));
  return all;
}

} // namespace gestell::apps
