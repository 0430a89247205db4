#pragma once

#include "apps/output/values/result.h"

#include <string>
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
};

/// All of them, in the order of writing; what prepare_folder() removes, and the list of docs/results.md.
const std::vector<ResultFile> &result_files();

/// The rows of that list.
std::string result_files_table();

} // namespace gestell::apps
