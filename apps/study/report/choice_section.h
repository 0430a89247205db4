#pragma once

#include "apps/output/text/svg.h"
#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

/// The best of the runs, by words; goals and limits of all families over an output, the window about the best as a bar.
/// Empty where a study did not ask.
std::string choice_section(const StudyFindings &findings, Pictures &pictures);

/// "run 83 of 98 ...": which run is the best, or that none keeps all limits.
std::string choice_text(const StudyFindings &findings);

} // namespace gestell::apps
