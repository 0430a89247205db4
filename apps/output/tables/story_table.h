#pragma once

#include "apps/output/values/run_story.h"

#include <string>

namespace gestell::apps
{

/// When a load acts and where its modes are listed, or why there are none; a note if output rows are too far apart.
std::string load_text(const LoadDuration &load);

/// For a terminal: the loads with the modes they excite, and the clearances.
std::string story_text(const RunStory &story);

} // namespace gestell::apps
