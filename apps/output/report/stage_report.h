#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Stages of the run, when wheels were off the ground, and what rings in the last stage; empty without them.
std::string stage_section(const Result &result);

} // namespace gestell::apps
