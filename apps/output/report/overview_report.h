#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// The computation in two sentences, and its most important numbers.
std::string overview(const Result &result);

} // namespace gestell::apps
