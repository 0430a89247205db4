#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/progress.h"
#include "apps/output/result_folder.h"
#include "apps/study/file/read_design.h"
#include "apps/study/runs/study_answer.h"
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

struct StudyCommand
{
  bool        resume = false;
  std::string share;
};

std::filesystem::path study_folder(const CommonOptions &options, const StudyFile &study)
{
  return options.folder.empty() ? std::filesystem::path("results") / study.name : std::filesystem::path(options.folder);
}

void print_failures(const StudyAnswer &answer)
{
  constexpr int most_told = 3;
  int           told      = 0;
  for (std::size_t i = 0; i < answer.table.runs.size() && told < most_told; ++i)
    if (answer.table.runs[i].status == RunStatus::failed && ++told)
      std::cerr << "gestell: warning: run " << i + 1 << " failed: " << answer.table.runs[i].message << '\n';
  if (answer.n_failed() > most_told)
    std::cerr << "gestell: warning: " << answer.n_failed() - most_told << " further runs failed; see runs.csv\n";
}

int study_scene(const CommonOptions &options, const StudyCommand &asked)
{
  setenv("OPENBLAS_NUM_THREADS", "1", 1); // processes, not threads, do the work
  const StudyFile             study  = read_study(options.input, options.overrides);
  const StudyPoints           points = read_design(study);
  const std::filesystem::path folder = study_folder(options, study);
  require_writable(folder);
  StudyRunner  runner(study, options.scripts, study.keep ? folder : std::filesystem::path());
  ProgressLine progress(options.quiet);
  StudyCall    call;
  call.folder   = folder;
  call.jobs     = options.jobs;
  call.stop     = &interruption();
  call.begin    = asked.resume ? StudyFolder::Begin::resumed : StudyFolder::Begin::anew;
  call.progress = [&](int done, int n) { progress.show("runs", double(done) / n); };
  if (!asked.share.empty())
    call.share = share_of(asked.share);
  const StudyAnswer answer = make_study(study, points, runner, call);
  progress.done();
  std::cout << study.name << ": " << count_text(std::size_t(answer.n_made), "run") << " made";
  if (answer.n_failed() > 0)
    std::cout << ", " << answer.n_failed() << " failed";
  std::cout << "\nrows: " << (folder / (call.share.is_whole() ? "runs.csv" : "")).string() << '\n';
  print_failures(answer);
  return answer.interrupted ? exit_interrupted : exit_done;
}

} // namespace

Command study_command()
{
  const auto asked = std::make_shared<StudyCommand>();
  return {"study",
          "sweep, design of experiments or optimisation over a scene",
          {"gestell study apps/studies/press_24.toml --jobs 2"},
          CommandInput::study,
          {{"--resume", &asked->resume, "go on with the study whose rows the folder holds"},
           {"--share", &asked->share, "make this part of the runs alone, such as 3/10; a call without it merges them"}},
          [asked](const CommonOptions &options) { return study_scene(options, *asked); }};
}

} // namespace gestell::apps
