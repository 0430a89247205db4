#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Event log, modes in the extremes of forces, loads against the periods, play by its describing function.
std::string story_section(const Result &result);

} // namespace gestell::apps
