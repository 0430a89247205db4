#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Whether a switch of the scene whose command is to end the run ended it early.
bool is_wanted_end(const coupling::RunResult &run);

/// history.csv: one row per output instant, header "name [unit]"; empty if the run has no columns.
CsvTable history_csv(const coupling::RunResult &run);

} // namespace gestell::apps
