#pragma once

#include "apps/output/text/json.h"
#include "apps/output/values/stage_result.h"

#include <string>

namespace gestell::apps
{

/// Of summary.json: `stages`, `lift_off`, `ringing`.
Json stages_json(const StageResult &result);
Json lift_off_json(const StageResult &result);
Json ringing_json(const StageResult &result);

/// The same for the terminal.
std::string stages_text(const StageResult &result);

} // namespace gestell::apps
