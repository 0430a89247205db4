#pragma once

#include "apps/output/charts/work_precision.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Names of the files of a chart, for OwnFolder::require_free().
const std::vector<std::string> &chart_files();

/// Writes the files in place of those of an earlier chart; files of other commands in the folder remain.
/// @throws coupling::WriteFailure as write_or_rescue() does
void write_chart(const std::filesystem::path &folder, const WorkPrecision &chart);

} // namespace gestell::apps
