#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

struct Result;

/// Who writes a file of results.
enum class WrittenBy
{
  write_results,
  its_command ///< beside the others: `frf --export`, `size`, `modes --converge`
};

/// A file of results at the top of their folder.
struct ResultFile
{
  std::string name;
  std::string holds; ///< one clause, in Markdown
  /// Its content; empty: `result` has none.  Null: it is written together with other files.
  std::string (*content)(const Result &result) = nullptr;
  std::string folder{}, ending{}; ///< that hold what the file names, "motion" and ".vtp"
  /// Of a name with a star, "orbit_*.csv": names and contents of all such files.
  std::vector<std::pair<std::string, std::string>> (*several)(const Result &result) = nullptr;
  WrittenBy by                                                                      = WrittenBy::write_results;
};

} // namespace gestell::apps
