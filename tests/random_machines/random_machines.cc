// Machines at random, computed by unrelated methods and judged by invariants: docs/develop/random_machines.md.

#include "tests/random_machines/judge.h"
#include "tests/random_machines/other_units.h"
#include "tests/random_machines/trial.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{

using namespace gestell::tests;

struct Settings
{
  std::uint64_t         first = 1, last = 200;
  int                   jobs = 1;
  std::filesystem::path folder;
  bool                  verbose = false, other_units = false;

  std::set<std::uint64_t> left_out;
};

/// What the processes tell each other.
struct Board
{
  std::uint64_t at[64]; ///< seed that each is at work on
  long          machines[64], findings[64];
  double        cpu_s[64];
  double        began[64]; ///< [s] of CPU time of the process, when it took up its seed
};

constexpr double patience = 120.; ///< [s] of CPU time for one machine

double cpu_seconds(clockid_t clock)
{
  timespec now{};
  ::clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::string line_of(std::uint64_t seed, const Finding &finding, const std::string &scene)
{
  std::ostringstream text;
  text.precision(6);
  text << seed << " | " << finding.kind << " | " << finding.way << " | " << finding.what << " | " << finding.value
       << " | " << finding.bound << " | " << scene << '\n';
  return text.str();
}

/// Seeds from `from` on in steps of the number of jobs.
void work(const Settings &settings, int job, std::uint64_t from, Board &board)
{
  const auto scratch = std::filesystem::temp_directory_path() / ("random_machines_" + std::to_string(::getpid()));
  for (std::uint64_t seed = from; seed <= settings.last; seed += settings.jobs)
  {
    if (settings.left_out.count(seed) > 0)
      continue;
    board.at[job]               = seed;
    board.began[job]            = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    const RandomMachine machine = random_machine(seed);
    const Verdict verdict = settings.other_units ? judge_in_other_units(machine, scratch) : judge(machine, scratch);
    const auto    kept    = settings.folder / std::to_string(seed);
    if (!verdict.findings.empty() && !settings.folder.empty())
      write_scene(machine, kept);
    std::string lines;
    for (const Finding &finding : verdict.findings)
      lines += line_of(seed, finding, settings.folder.empty() ? "-" : (kept / "scene.toml").string());
    if (settings.verbose)
      lines += (verdict.sensitive ? "sensitive " : "") + std::to_string(seed) + " took " +
               std::to_string(verdict.cpu_s) + " s, " + machine.kind + "\n";
    std::cout << lines << std::flush;
    ++board.machines[job];
    board.findings[job] += long(verdict.findings.size());
    board.cpu_s[job] += verdict.cpu_s;
    std::filesystem::remove_all(scratch);
  }
}

void stop_if_hung(pid_t child, double began)
{
  clockid_t clock{};
  if (::clock_getcpuclockid(child, &clock) == 0 && cpu_seconds(clock) - began > patience)
    ::kill(child, SIGKILL);
}

/// Each job in a process of its own, so that a crash is a finding of its seed.
int run_all(const Settings &settings)
{
  auto *board =
      static_cast<Board *>(::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  std::map<pid_t, int> jobs;
  const auto           start = [&](int job, std::uint64_t from)
  {
    board->at[job]    = from;
    board->began[job] = 0.;
    const pid_t child = ::fork();
    if (child == 0)
    {
      work(settings, job, from, *board);
      ::_exit(0);
    }
    jobs[child] = job;
  };
  for (int job = 0; job < settings.jobs; ++job)
    start(job, settings.first + std::uint64_t(job));
  while (!jobs.empty())
  {
    int         status = 0;
    const pid_t child  = ::waitpid(-1, &status, WNOHANG);
    if (child == 0)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      for (const auto &[running, job] : jobs)
        stop_if_hung(running, board->began[job]);
      continue;
    }
    const int job = jobs[child];
    jobs.erase(child);
    if (!WIFSIGNALED(status))
      continue;
    const int   signal = WTERMSIG(status);
    const char *kind   = signal == SIGKILL ? "hangs" : "crash";
    std::cout << line_of(board->at[job], {kind, "-", "signal", double(signal), 0.}, "-") << std::flush;
    ++board->findings[job];
    start(job, board->at[job] + std::uint64_t(settings.jobs));
  }
  long   machines = 0, findings = 0;
  double cpu_s = 0.;
  for (int job = 0; job < settings.jobs; ++job)
  {
    machines += board->machines[job];
    findings += board->findings[job];
    cpu_s += board->cpu_s[job];
  }
  std::cout << machines << " machines, " << findings << " findings, " << cpu_s << " s of CPU time\n";
  return findings == 0 ? 0 : 3;
}

} // namespace

int main(int argc, char **argv)
{
  CLI::App                     app("Machines at random, computed by unrelated methods and judged by invariants");
  Settings                     settings;
  std::string                  seeds = "1..200", folder;
  std::optional<std::uint64_t> one;
  std::vector<std::uint64_t>   but;
  app.add_option("--seeds", seeds, "first and last seed, \"1..2000\"");
  app.add_option("--jobs", settings.jobs, "processes at once")->check(CLI::Range(1, 64));
  app.add_option("--but", but, "seeds that are left out, as their findings are known")->delimiter(',');
  app.add_option("--write", one, "only write the scene of this seed into -o");
  app.add_option("-o,--output", folder, "folder for scenes of findings");
  app.add_flag("--other-units", settings.other_units, "each machine in other units instead of by other methods");
  app.add_flag("--verbose", settings.verbose, "a line for every machine");
  CLI11_PARSE(app, argc, argv);
  settings.folder   = folder;
  settings.left_out = {but.begin(), but.end()};
  if (one)
  {
    std::cout << write_scene(random_machine(*one), settings.folder.empty() ? "." : settings.folder).string() << '\n';
    return 0;
  }
  const auto dots = seeds.find("..");
  settings.first  = std::stoull(seeds.substr(0, dots));
  settings.last   = dots == std::string::npos ? settings.first : std::stoull(seeds.substr(dots + 2));
  return run_all(settings);
}
