#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// The deformed machine at the main peak of a run; empty where there is none or nothing to be seen.
std::string peak_figure(const Result &result, Pictures &pictures);

/// The lowest coupled modes, frame and mechanism together, deformed; empty where there is nothing to be seen.
std::string coupled_mode_pictures(const Result &result, Pictures &pictures);

} // namespace gestell::apps
