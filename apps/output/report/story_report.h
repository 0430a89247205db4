#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// The run told by its events; how long loads act against the periods; play by its describing function.
std::string story_section(const Result &result);

} // namespace gestell::apps
