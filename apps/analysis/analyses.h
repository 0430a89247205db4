#pragma once

#include "apps/analysis/analysis.h"

namespace gestell::apps
{

/// All of them, in the order of reports.
const std::vector<AnalysisEntry> &analyses();

/// @throws std::invalid_argument with the nearest name
const AnalysisEntry &analysis_named(const std::string &name);

/// What it finds of the session's scene.
Result computed(const AnalysisEntry &entry, const Analysis &analysis, Session &session);

/// A result with an answer of each, for the lists of what summary.json may hold.
Result result_of_all_kinds();

} // namespace gestell::apps
