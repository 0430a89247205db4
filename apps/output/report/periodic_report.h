#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Section on the periodic solutions with stability, multipliers relative to the unit circle, harmonics, and the
/// branches along a parameter with their special points.  Empty if there are none.
std::string periodic_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
