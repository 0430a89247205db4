#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

struct Result;

/// Which code writes a file of results.
enum class WrittenBy
{
  write_results,
  its_command ///< the command itself: `frf --export`, `size`, `modes --converge`
};

/// A file of results at the top level of their folder.
struct ResultFile
{
  std::string name;
  std::string holds; ///< contents in one clause, in Markdown
  /// Its content; empty if `result` has none.  Null: it is written together with other files.
  std::string (*content)(const Result &result) = nullptr;
  std::string folder{}, ending{}; ///< folder and extension of the files that it references, "motion" and ".vtp"
  /// For a name with a star, "orbit_*.csv": names and contents of all such files.
  std::vector<std::pair<std::string, std::string>> (*several)(const Result &result) = nullptr;
  WrittenBy by                                                                      = WrittenBy::write_results;
};

} // namespace gestell::apps
