#pragma once

#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "apps/study/report/study_findings.h"

namespace gestell::apps
{

/// Smallest and largest value of the first outputs, with the runs that have them, and the optimum if there is one.
Headline study_headline(const StudyFindings &findings, const std::string &sentence);

/// Each output over the first variable with numbers: curves by the other variables, or dots where these are many.
std::string over_variable_section(const StudyFindings &findings, Pictures &pictures);

} // namespace gestell::apps
