#include "tests/apps/disk/disk_cases.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <random>
#include <regex>
#include <thread>
#include <utime.h>

namespace gestell::tests
{
namespace
{

namespace fs   = std::filesystem;
using Json     = nlohmann::json;
using Contents = std::map<std::string, std::string>;

const std::string press =
    "'" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml' --set run.step=20e-6 --set run.end=0.4 ";
const std::string of_press = "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                             "set = { 'run.step' = 20e-6, 'run.end' = 0.4 }\n"
                             "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                             "[outputs]\nF = 'signals.F_P.max'\n[surface]\n"
                             "[design]\ntype = 'Sobol'\nruns = 6\n";

#ifdef GESTELL_WITH_FEM
const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.4, 0.1, 0.1};\n";
const std::string frame =
    "name = 'box'\n[frame]\ncad = 'box.geo'\nunit = '1 m'\nmesh = { size = '100 mm' }\nmaterial = 'steel'\n"
    "[frame.surface.left]\nplane = { normal = [-1, 0, 0], through = [0, 0, 0] }\n"
    "[frame.surface.right]\nplane = { normal = [1, 0, 0], through = ['0.4 m', 0, 0] }\n"
    "[frame.support.wall]\nsurface = 'left'\nclamped = true\n"
    "[frame.interface.end]\nsurface = 'right'\ncoupling = 'rigid'\n"
    "[reduction]\nmethod = 'craig-bampton'\nmodes = 4\n";
#endif

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Without what the clock tells.
std::string timeless(const std::string &name, const std::string &text)
{
  if (ends_with(name, "summary.json"))
  {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded())
      return "cut";
    Json kept = json;
    for (const char *key : {"wall_s", "warnings", "findings", "asked"})
      kept.erase(key);
    return kept.dump();
  }
  if (ends_with(name, ".html"))
    return ends_with(text, "</html>\n") ? "whole" : "cut";
  if (ends_with(name, "runs.csv"))
    return std::regex_replace(text, std::regex(",[^,\n]*\n"), "\n");
  return text;
}

void clear(const fs::path &folder)
{
  std::error_code none;
  fs::remove_all(folder, none);
}

std::string elsewhere(const Answer &answer)
{
  const std::string begin = "all results are in ", end = " instead";
  const auto        from = answer.text.find(begin), to = answer.text.find(end);
  return from == std::string::npos ? "" : answer.text.substr(from + begin.size(), to - from - begin.size());
}

/// A folder in which one case is tried again and again.
struct Trial
{
  const DiskCases &cases;
  const DiskCase  &one;
  fs::path         folder = cases.path("trial_" + one.name), results = folder / "results";

  Answer call(const std::string &more = "", const std::string &before = "") const
  {
    return shell(cases.command(one, results, more, before));
  }
  /// A second call; one of a study goes on where rows are there.
  Answer again() const
  {
    const Answer answer = call();
    return answer.exit_code == 2 && answer.says("continue with --resume") ? call("--resume") : answer;
  }
  Contents undisturbed(const std::string &more = "") const
  {
    clear(folder);
    fs::create_directories(folder);
    const Answer answer = call(more);
    EXPECT_EQ(answer.exit_code, 0) << one.name << ": " << answer.text;
    return contents(results);
  }
};

/// Words of the shell under which the disk fails at a call.
std::string failing(const Trial &trial, long call, bool full)
{
  return "GESTELL_DISK='" + trial.folder.string() + "' GESTELL_DISK_COUNT='" + trial.cases.path("calls").string() +
         "' GESTELL_DISK_CALL=" + std::to_string(call) + (full ? " GESTELL_DISK_FULL=1" : "") +
         " LD_PRELOAD='" GESTELL_BINARY_DIR "/tests/gestell_failing_disk.so' ";
}

void reset_calls(const DiskCases &cases)
{
  std::ofstream(cases.path("calls"), std::ios::binary) << std::string(sizeof(long), '\0');
}

long calls(const DiskCases &cases)
{
  long n = 0;
  std::ifstream(cases.path("calls"), std::ios::binary).read(reinterpret_cast<char *>(&n), sizeof n);
  return n;
}

/// Whether all lines of a text are whole lines of another one: rows of a study, in the order in which they were made.
bool has_lines(const std::string &all, const std::string &some)
{
  std::istringstream lines(some);
  for (std::string line; std::getline(lines, line);)
    if (('\n' + all).find('\n' + line + '\n') == std::string::npos)
      return false;
  return some.empty() || some.back() == '\n';
}

/// Files are whole: as they were, or as they are to be.
void expect_whole(const Contents &found, const Contents &before, const Contents &right, const std::string &where)
{
  const auto is = [](const Contents &all, const std::string &name, const std::string &text)
  {
    const auto at = all.find(name);
    return at != all.end() && (at->second == text || (ends_with(name, "runs.csv") && has_lines(at->second, text)));
  };
  for (const auto &[name, text] : found)
  {
    EXPECT_EQ(name.find("unfinished-"), std::string::npos) << where << name;
    EXPECT_NE(text, "cut") << where << name;
    // A record of a study tells what was called; a checkpoint has a checksum, and a second call goes on from it.
    if (!ends_with(name, "study.json") && !ends_with(name, "checkpoint.bin"))
    {
      EXPECT_TRUE(is(before, name, text) || is(right, name, text)) << where << name << " is not whole";
    }
  }
}

/// What is there is right; of what is not nothing is said.
void expect_part(const fs::path &folder, const Contents &right, const std::string &where)
{
  const Contents found = contents(folder);
  EXPECT_FALSE(found.empty()) << where;
  for (const auto &[name, text] : found)
    EXPECT_TRUE(right.count(name) && right.at(name) == text) << where << name;
}

/// One call fails; whether the program noticed.
bool fail_at(const Trial &trial, long call, bool full, const Contents &before, const Contents &right)
{
  const std::string where = trial.one.name + ", call " + std::to_string(call) + (full ? " and behind: " : ": ");
  reset_calls(trial.cases);
  const Answer answer = trial.call("", failing(trial, call, full));
  if (answer.exit_code == 0) // a note in the cache, the shorter list of files
  {
    EXPECT_EQ(difference(contents(trial.results), right), "") << where << answer.text;
    return false;
  }
  EXPECT_TRUE(answer.exit_code == 3 || answer.exit_code == 2) << where << answer.exit_code << ' ' << answer.text;
  EXPECT_TRUE(answer.says("No space left on device")) << where << answer.text;
  EXPECT_TRUE(answer.says(trial.folder.string())) << where << answer.text;
  expect_whole(contents(trial.results), before, right, where);
  if (const std::string path = elsewhere(answer); !path.empty())
  {
    expect_part(path, right, where + "elsewhere: ");
    clear(path);
  }
  return true;
}

/// Made older than an hour, they are removed by a further call.
void expect_leftovers_to_go(const Trial &trial)
{
  const utimbuf long_ago{1000000000, 1000000000};
  for (const auto &entry : fs::recursive_directory_iterator(trial.folder))
    if (entry.path().filename().string().rfind("unfinished-", 0) == 0)
      utime(entry.path().c_str(), &long_ago);
  EXPECT_EQ(trial.again().exit_code, 0);
  for (const auto &entry : fs::recursive_directory_iterator(trial.results))
    EXPECT_NE(entry.path().filename().string().rfind("unfinished-", 0), 0u) << entry.path();
}

/// Starts a command and kills it after some time [s]; whether it was alive then.
bool killed(const std::string &command, double after)
{
  const pid_t child = fork();
  if (child == 0)
  {
    execl("/bin/sh", "sh", "-c", ("exec >/dev/null 2>&1; " + command).c_str(), nullptr);
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(after));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

} // namespace

DiskCases::DiskCases()
{
  reset_calls(*this);
  fs::create_directories(path("temp"));
  const std::string study = folder_.file("s.toml", of_press);
  cases_                  = {{"run", "run " + press + "--checkpoint 0.005", "--resume", "checkpoint.bin"},
                             {"modes", "modes " + press + "--along crank --positions 5"},
                             {"frf", "frf " + press + "--from frame.crown.uz --to F_P --points 20 --export matrix-market"},
                             {"stability", "stability " + press + "--zeta 0.01"},
                             {"study", "study " + study + " --jobs 2", "--resume", "runs.csv"},
                             {"export", "export " + press}};
#ifdef GESTELL_WITH_FEM
  folder_.file("box.geo", box);
  const std::string scene = folder_.file("box.toml", frame);
  cases_.push_back({"reduce", "reduce " + scene + " --export petsc"});
  cases_.push_back({"mesh", "mesh '" + path("box.geo").string() + "' --size '100 mm' --unit '1 m'"});
#endif
}

std::string DiskCases::command(const DiskCase &one, const fs::path &results, const std::string &more,
                               const std::string &before) const
{
  const std::string cache = (results.parent_path() / "cache").string();
  return "TMPDIR='" + path("temp").string() + "' GESTELL_CACHE='" + cache + "' " + before +
         "exec '" GESTELL_BINARY_DIR "/bin/gestell' " + one.arguments + (one.name == "mesh" ? "" : " --quiet") +
         " -o '" + results.string() + "' " + more;
}

Contents contents(const fs::path &folder)
{
  Contents all;
  if (fs::exists(folder))
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      if (const std::string name = entry.path().lexically_relative(folder).generic_string();
          entry.is_regular_file() && entry.path().filename() != ".gestell-files" &&
          entry.path().filename() != ".gestell-lock")
        all[name] = timeless(name, read(entry.path()));
  return all;
}

std::string difference(const Contents &found, const Contents &right)
{
  std::string text;
  for (const auto &[name, content] : right)
    if (!found.count(name))
      text += name + " is missing\n";
    else if (found.at(name) != content)
      text += name + " differs\n";
  for (const auto &[name, content] : found)
    if (!right.count(name) && name.find("unfinished-") == std::string::npos)
      text += name + " is too many\n";
  return text;
}

int fail_writes(const DiskCases &cases, int per_case)
{
  int all = 0;
  for (const DiskCase &one : cases.all())
  {
    const Trial    trial{cases, one};
    const Contents right = trial.undisturbed();
    reset_calls(cases);
    clear(trial.folder);
    fs::create_directories(trial.folder);
    EXPECT_EQ(trial.call("", failing(trial, 0, false)).exit_code, 0);
    const long n       = calls(cases);
    int        noticed = 0;
    EXPECT_GT(n, 0) << one.name;
    for (int i = 0; i < per_case; ++i)
    {
      const Contents before = contents(trial.results);
      if (one.name == "reduce" || i % 3 == 0) // into a new folder, too
        clear(trial.folder), fs::create_directories(trial.folder);
      noticed += fail_at(trial, 1 + (i * n) / per_case, i % 2 == 1, before, right);
      const Answer again = trial.again();
      EXPECT_EQ(again.exit_code, 0) << one.name << ' ' << i << ": " << again.text;
      EXPECT_EQ(difference(contents(trial.results), right), "") << one.name << ' ' << i;
    }
    std::cout << one.name << ": " << n << " calls that change files, " << per_case << " failed, " << noticed
              << " told\n";
    all += per_case;
  }
  return all;
}

int kill_often(const DiskCases &cases, int per_case, unsigned seed)
{
  std::mt19937 random(seed);
  int          all = 0;
  for (const DiskCase &one : cases.all())
  {
    const Trial                            trial{cases, one};
    const auto                             begin = std::chrono::steady_clock::now();
    const Contents                         right = trial.undisturbed();
    const std::chrono::duration<double>    takes = std::chrono::steady_clock::now() - begin;
    std::uniform_real_distribution<double> instants(0.05 * takes.count(), takes.count());
    int                                    met = 0, resumed = 0;
    for (int i = 0; i < per_case; ++i)
    {
      clear(trial.folder);
      fs::create_directories(trial.folder);
      met += killed(cases.command(one, trial.results), instants(random));
      const bool   goes_on = !one.resume.empty() && fs::exists(trial.results / one.known);
      const Answer again   = trial.call(goes_on ? one.resume : "");
      resumed += goes_on;
      EXPECT_EQ(again.exit_code, 0) << one.name << ' ' << i << ": " << again.text;
      EXPECT_EQ(difference(contents(trial.results), right), "") << one.name << ' ' << i;
    }
    expect_leftovers_to_go(trial);
    std::cout << one.name << ": " << met << " kills, of " << per_case << "; went on " << resumed << " times\n";
    all += met;
  }
  return all;
}

} // namespace gestell::tests
