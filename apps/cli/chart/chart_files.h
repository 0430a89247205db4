#pragma once

#include "apps/output/charts/work_precision.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Names of the files of a chart, for OwnFolder::require_free().
const std::vector<std::string> &chart_files();

/// Writes them in place of those of an earlier chart; what other commands left in the folder stays.
/// @throws coupling::WriteFailure as write_or_rescue()
void write_chart(const std::filesystem::path &folder, const WorkPrecision &chart);

} // namespace gestell::apps
