#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Modes of the scene beside those of another one; adds its picture.  Empty where none were compared.
std::string compared_modes_section(const Result &result, Pictures &pictures);

/// The run beside that of another scene: extremes, signals in one chart.  Empty where none was compared.
std::string compared_run_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
