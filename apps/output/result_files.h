#pragma once

#include "apps/output/values/result.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// A file of results at the top of their folder.
struct ResultFile
{
  std::string name;
  std::string holds; ///< one clause, in Markdown
  /// What stands in it; empty: `result` has nothing for it.  Null: written by what makes several files at once.
  std::string (*content)(const Result &result) = nullptr;
  std::string folder{}, ending{}; ///< that hold what the file names, "motion" and ".vtp"
  /// Of a name with a star, "orbit_*.csv": names and contents of all such files.
  std::vector<std::pair<std::string, std::string>> (*several)(const Result &result) = nullptr;

  bool has_name(const std::string &file) const; ///< the name is that, or of that form
};

/// All of them, in the order of writing; what prepare_folder() removes, and the list of docs/results.md.
const std::vector<ResultFile> &result_files();

/// The rows of that list.
std::string result_files_table();

} // namespace gestell::apps
