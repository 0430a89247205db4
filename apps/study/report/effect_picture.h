#pragma once

#include "apps/study/surface/response_surface.h"

#include <string>

namespace gestell::apps
{

/// Tornado of an output: how far it goes from its value in the middle of all ranges as one variable goes to either end
/// of its own, and what two together add in the corners; the widest first.  SVG.
std::string effect_picture(const ResponseSurface &surface);

} // namespace gestell::apps
