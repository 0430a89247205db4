#pragma once

#include "apps/output/report/section.h"
#include "apps/output/values/along_result.h"

namespace gestell::apps
{

/// Frequencies over the coordinate, one line per tracked mode, in as many charts as keep them legible: within one the
/// highest frequency is at most six times the lowest, and there are at most seven lines.  Orders of the excitation
/// are horizontal lines, rings mark where one comes near a frequency.  Lines without frequency are left out.
std::vector<Section> sections_of(const Result &result, const AlongResult &along);

} // namespace gestell::apps
