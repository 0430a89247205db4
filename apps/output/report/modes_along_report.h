#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Pictures of the frequencies over the coordinate, one line per tracked mode, in as many charts as keep them legible:
/// within one the highest frequency is at most six times the lowest, and there are at most seven lines.  Orders of the
/// excitation are horizontal lines, rings mark where one comes near a frequency.  Lines without frequency are left out.
Pictures along_pictures(const AlongResult &along);

/// The section of the report; adds its pictures.  "" without such a result.
std::string along_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
