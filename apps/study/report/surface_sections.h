#pragma once

#include "apps/output/text/svg.h"
#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

// Sections of the report on a study about its surfaces, as HTML; their pictures are added to `pictures`.  Empty without
// surfaces.

/// Tornado of each output, and the shares of its variance.
std::string effects_section(const StudyFindings &findings, Pictures &pictures);

/// Quality, contours, slices, predicted against computed, coefficients and residuals.
std::string surfaces_section(const StudyFindings &findings, Pictures &pictures);

} // namespace gestell::apps
