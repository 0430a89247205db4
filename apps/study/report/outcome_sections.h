#pragma once

#include "apps/output/text/svg.h"
#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

// Sections of the report on a study about optimum, front and scatter, as HTML; empty if not requested.

/// Where the optimum lies, what it gains, whether a run confirms it, and the searches.
std::string optimum_section(const StudyFindings &findings);

/// Front of two goals; of more, every pair.
std::string front_section(const StudyFindings &findings, Pictures &pictures);

/// Mean, deviation and quantiles under scatter, with their errors.
std::string robust_section(const StudyFindings &findings);

} // namespace gestell::apps
