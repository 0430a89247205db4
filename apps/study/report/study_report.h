#pragma once

#include "apps/output/text/svg.h"
#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

/// The page of a study and its pictures as files.
struct StudyReport
{
  std::string html;
  Pictures    pictures; ///< names hold letters, digits and _ alone
};

/**
 * One self-contained page: optimum, effects, front, surfaces, scatter, runs.  What the study did not ask for is left
 * out. Outputs of surfaces, optimum and front stand in the order of the table's.
 */
StudyReport make_study_report(const StudyFindings &findings);

} // namespace gestell::apps
