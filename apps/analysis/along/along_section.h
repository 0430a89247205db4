#pragma once

#include "apps/output/report/section.h"
#include "apps/output/values/along_result.h"

namespace gestell::apps
{

/// Sections with the frequencies over the coordinate, one line per tracked mode.  The lines are split into several
/// charts to keep them legible: in one chart the highest frequency is at most six times the lowest, and there are at
/// most seven lines.  Orders of the excitation are horizontal lines; rings mark where an order is close to a frequency.
/// Lines without frequency are omitted.
std::vector<Section> sections_of(const Result &result, const AlongResult &along);

} // namespace gestell::apps
