#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// history.csv: one row per output instant, header "name [unit]", full precision.
std::string history_csv(const coupling::RunResult &run);

/// modes.csv: modes of the frame alone, then of the coupled machine, each numbered from 1, full precision.
std::string modes_csv(const Result &result);

} // namespace gestell::apps
