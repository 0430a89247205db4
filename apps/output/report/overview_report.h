#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// What was computed in two sentences, and the numbers that matter most.
std::string overview(const Result &result);

} // namespace gestell::apps
