#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Event log, modes in the extremes of forces, load durations relative to mode periods, clearances.
std::string story_section(const Result &result);

} // namespace gestell::apps
