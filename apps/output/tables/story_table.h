#pragma once

#include "apps/output/values/run_story.h"

#include <string>

namespace gestell::apps
{

/// When a load acts and where its modes are found, or why there are none; that rows are too far apart, and the way out.
std::string load_text(const LoadDuration &load);

/// For a terminal: the loads with the modes they excite, and the plays.
std::string story_text(const RunStory &story);

} // namespace gestell::apps
