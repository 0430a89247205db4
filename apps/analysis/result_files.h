#pragma once

#include "apps/output/values/result_file.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// All files of results, those of analyses last, in the order of writing: the files that prepare_folder() removes, and
/// the list in docs/reference/results.md.
const std::vector<ResultFile> &result_files();

/// Names that write_results() may write, for OwnFolder::require_free(); folders end in "/": "motion/".
std::vector<std::string> result_names();

/// Whether a name, relative to the folder, is in the list or in a folder of results.
bool is_result(const std::string &name);

/// Table rows of that list.
std::string result_files_table();

} // namespace gestell::apps
