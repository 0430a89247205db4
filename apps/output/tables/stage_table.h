#pragma once

#include "apps/output/values/stage_result.h"

#include <string>

namespace gestell::apps
{

/// For the terminal.
std::string stages_text(const StageResult &result);

} // namespace gestell::apps
