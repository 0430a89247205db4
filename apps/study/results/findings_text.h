#pragma once

#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

/// What was found, for people.
std::string findings_text(const StudyFindings &findings);

} // namespace gestell::apps
