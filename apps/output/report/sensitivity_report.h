#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

namespace gestell::apps
{

/// Section of the sensitivities: for the largest and smallest values of the first signals a tornado, what 1 % more of
/// each entry of the scene changes, the largest change on top; for all outputs a table.  Empty: none were asked for.
std::string sensitivity_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
