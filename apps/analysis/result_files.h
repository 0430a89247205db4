#pragma once

#include "apps/output/values/result_file.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// All of them, those of analyses last, in the order of writing; what prepare_folder() removes, and the list of
/// docs/results.md.
const std::vector<ResultFile> &result_files();

/// Names that write_results() may write, for OwnFolder::require_free(); of folders "motion/".
std::vector<std::string> result_names();

/// Whether a name, relative to the folder, is one of the list: of a result, or in a folder of results.
bool is_result(const std::string &name);

/// The rows of that list.
std::string result_files_table();

} // namespace gestell::apps
