#pragma once

#include "apps/study/surface/response_surface.h"

#include <string>

namespace gestell::apps
{

/// Tornado of an output: how far it goes from its value in the middle of all ranges as one variable goes to either end
/// of its own, and what two together add in the corners; the widest first.  SVG.
/// @param computed  by the run in the middle, told beside the surface; nan: none was made
std::string effect_picture(const ResponseSurface &surface, double computed);

} // namespace gestell::apps
