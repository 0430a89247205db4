#pragma once

#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

/// output, term, coefficient, confidence: half width of its interval; variables coded.
std::string surface_csv(const std::vector<ResponseSurface> &surfaces);
/// How well each surface tells its runs, and those it does not know.
std::string fit_csv(const std::vector<ResponseSurface> &surfaces);
/// output, effect, kind, value, confidence, share.
std::string effects_csv(const std::vector<ResponseSurface> &surfaces);
/// The points of the front: variables, outputs.
std::string pareto_csv(const std::vector<ParetoPoint> &front, const StudyTable &table);
/// What scatter makes of each output.
std::string robust_csv(const std::vector<RobustResult> &robust);

/// What was found, for people.
std::string findings_text(const StudyFindings &findings);

} // namespace gestell::apps
