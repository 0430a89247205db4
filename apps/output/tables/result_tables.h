#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Whether the run ended early by a switch of the scene that is to end it.
bool is_wanted_end(const coupling::RunResult &run);

/// history.csv: one row per output instant, header "name [unit]", full precision.
std::string history_csv(const coupling::RunResult &run);

/// modes.csv: modes of the frame alone, then of the coupled machine, each numbered from 1, full precision.
std::string modes_csv(const Result &result);

} // namespace gestell::apps
