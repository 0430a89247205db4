#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/command_answers.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/cli/team.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/folder_lock.h"
#include "apps/study/results/findings_text.h"
#include "apps/study/results/study_analysis.h"
#include "apps/study/results/study_files.h"
#include "apps/study/runs/study_folder.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>

namespace gestell::apps
{
namespace
{

/**
 * Locks the folder of a study during its lifetime: one call at a time makes or merges all of it; several calls can make
 * shares in parallel.
 */
class StudyLock : public FolderLock
{
public:
  /// @throws std::invalid_argument with the process that has locked the folder
  StudyLock(const std::filesystem::path &folder, const StudyShare &share);
};

StudyLock::StudyLock(const std::filesystem::path &folder, const StudyShare &share)
    : FolderLock(folder, share.is_whole() ? Kind::alone : Kind::beside_others,
                 share.is_whole() ? "is running a study there" : "is running a share of a study there",
                 ", or name another folder with -o")
{
}

struct StudyCommand
{
  bool        resume = false;
  std::string share;
};

std::filesystem::path study_folder(const CommonOptions &options, const StudyFile &study)
{
  return options.folder.empty() ? std::filesystem::path("results") / study.name : std::filesystem::path(options.folder);
}

void print_rows(const StudyAnswer &answer, const StudyFile &study, const StudyCall &call)
{
  std::cout << study.name << ": " << count_text(std::size_t(answer.n_made), "run") << " made";
  if (answer.n_failed() > 0)
    std::cout << ", " << answer.n_failed() << " failed";
  if (!answer.complete())
    std::cout << ", "
              << std::count_if(answer.table.runs.begin(), answer.table.runs.end(),
                               [](const StudyRun &run) { return run.status == RunStatus::waiting; })
              << " remaining; --resume continues";
  const bool merged = call.share.is_whole() || call.waits_for_shares;
  std::cout << "\nrows: " << (call.folder / (merged ? "runs.csv" : StudyFolder::name_of(call.share))).string() << '\n';

  constexpr int most_listed = 3; // lines of standard error; runs.csv has all
  int           reported    = 0;
  for (std::size_t i = 0; i < answer.table.runs.size() && reported < most_listed; ++i)
    if (answer.table.runs[i].status == RunStatus::failed && ++reported)
      std::cerr << "gestell: warning: run " << i + 1 << " failed: " << answer.table.runs[i].message << '\n';
  if (answer.n_failed() > most_listed)
    std::cerr << "gestell: warning: " << answer.n_failed() - most_listed << " further runs failed; see runs.csv\n";
}

std::vector<std::filesystem::path> study_inputs(const CommonOptions &options, const StudyFile &study)
{
  std::vector<std::filesystem::path> inputs = input_files(study.scene, {});
  inputs.emplace_back(options.input);
  return inputs;
}

/// Each rank of mpirun computes a share; the first merges them.
void share_among_ranks(const coupling::Launch &ranks, StudyCall &call)
{
  if (ranks.size == 1)
    return;
  if (!call.share.is_whole())
    throw std::invalid_argument("--share: the ranks of mpirun already share the runs; remove --share or mpirun");
  call.share            = {ranks.rank + 1, ranks.size, true};
  call.waits_for_shares = ranks.rank == 0;
}

int study_scene(const CommonOptions &options, const StudyCommand &requested)
{
  setenv("OPENBLAS_NUM_THREADS", "1", 1); // processes, not threads, do the work
  const StudyFile       study    = read_study(options.input, options.overrides);
  const StudyPoints     points   = read_design(study);
  const AnalysisRequest analysis = read_analysis(study, points.design.n_runs());
  check_analysis(analysis, study, points);
  StudyCall call;
  call.folder = study_folder(options, study);
  call.jobs   = options.jobs;
  call.stop   = &interruption();
  call.begin  = requested.resume ? StudyFolder::Begin::resumed : StudyFolder::Begin::anew;
  if (!requested.share.empty())
    call.share = share_of(requested.share);
  const bool speaks = team_left().rank == 0;
  share_among_ranks(team_left(), call);
  require_writable(call.folder);
  OwnFolder(call.folder).require_free(study_names(), study_inputs(options, study));
  if (OwnFolder(call.folder).owns("summary.json"))
    throw std::invalid_argument("result folder " + call.folder.string() +
                                ": it contains results of another command, whose report would be overwritten; name "
                                "another folder with -o DIR, or remove its summary.json.");
  const StudyLock lock(call.folder, call.share);
  if (!lock.note().empty() && speaks)
    std::cerr << "gestell: warning: " << lock.note() << '\n';
  StudyRunner  runner(study, points.levels, options.scripts, study.keep ? call.folder : std::filesystem::path());
  ProgressLine progress(options.quiet || !speaks);
  call.progress            = [&](int done, int n) { progress.show("runs", double(done) / n); };
  call.learned             = [&](const std::vector<StudyOutput> &outputs) { check_units(analysis.claims, outputs); };
  const StudyAnswer answer = make_study(study, points, runner, call);
  progress.done();
  if (!speaks)
    return answer.interrupted ? exit_interrupted : exit_done;
  if (answers_in_json())
    answer_with(study_answer(answer, nullptr));
  print_rows(answer, study, call);
  if (answer.interrupted)
    return exit_interrupted;
  if (!answer.complete())
    return exit_done; // a share
  if (answer.table.n_done() == 0)
  {
    std::cerr << "gestell: the computation failed: no run of the study succeeded\n";
    return exit_failed;
  }
  const StudyFindings findings = StudyAnalysis(study, analysis, runner, call).of(answer);
  if (findings.optimum && !interruption())
    runner.settle(levels_of(findings), call.stop);
  if (answers_in_json())
    answer_with(study_answer(answer, &findings));
  write_findings(call.folder, study, runner.variants(), findings);
  for (const std::string &warning : findings.warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << findings_text(findings) << "report: " << (call.folder / "report.html").string() << '\n';
  return interruption() ? exit_interrupted : exit_done;
}

} // namespace

Command study_command()
{
  const auto requested = std::make_shared<StudyCommand>();
  return {
      "study",
      "sweep, design of experiments or optimisation over a scene",
      {"gestell study apps/studies/press_24.toml --jobs 2"},
      CommandInput::study,
      {{"--resume", &requested->resume, "continue the study in the folder"},
       {"--share", &requested->share,
        "run only one share of the runs: 3/10 is the third of ten; a final call without the option merges the shares"}},
      [requested](const CommonOptions &options) { return study_scene(options, *requested); }};
}

} // namespace gestell::apps
