#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Section of the error budget: errors of the outputs stacked by their cause beside what each cost to find out.  Empty:
/// there is none.
std::string budget_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
