#pragma once

#include "tests/support/program.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::tests
{

/// A call of the program that leaves files in a folder, its results the same whenever it is made.
struct DiskCase
{
  std::string name;
  std::string arguments; ///< "{folder}" stands for the folder of results
  std::string resume{};  ///< what is added to go on after a kill; "" to begin anew
  std::string known{};   ///< the file whose presence says that --resume is possible; "": it always is
};

/// Calls of run, modes, frf, periodic, stability, study, export, and with finite elements reduce and mesh.
class DiskCases
{
public:
  DiskCases(); ///< writes their scenes

  const std::vector<DiskCase> &all() const { return cases_; }

  /// Shell words of a case: result folder, further options, words that stand before the program.
  std::string           command(const DiskCase &one, const std::filesystem::path &results, const std::string &more = "",
                                const std::string &before = "") const;
  std::filesystem::path path(const std::string &name) const { return folder_ / name; }

private:
  Folder                folder_ = Folder("disk_cases");
  std::vector<DiskCase> cases_;
};

/// Files below a folder by their names, without what the clock tells: times in summaries and pages, seconds of rows.
std::map<std::string, std::string> contents(const std::filesystem::path &folder);

/// What of a folder is not as in another one that is right; "" if nothing.
std::string difference(const std::map<std::string, std::string> &found,
                       const std::map<std::string, std::string> &right);

/// Lets the disk fail in every case at so many calls, spread over all that it makes, by turns for one call and from
/// there on. Judges exit code, message, files and that a second call works.  @return how often a write failed
int fail_writes(const DiskCases &cases, int per_case);

/// Kills every case so often by SIGKILL, at instants spread over the time that it takes; then it goes on, or is made
/// again, and must leave what an undisturbed one does.  @return how many kills met a living process
int kill_often(const DiskCases &cases, int per_case, unsigned seed);

} // namespace gestell::tests
