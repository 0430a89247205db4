#pragma once

#include "apps/output/text/csv.h"
#include "apps/study/report/study_findings.h"

namespace gestell::apps
{

/// `surface.csv`: output, term, coefficient (of coded variables, in the output's SI unit), confidence (half width;
/// empty: unknown).
CsvTable surface_csv(const std::vector<ResponseSurface> &surfaces);

/// `surface_quality.csv`: output and the numbers of FitQuality.
CsvTable surface_quality_csv(const std::vector<ResponseSurface> &surfaces);

/// `effects.csv`: output, effect, kind, value, confidence, share of variance.
CsvTable effects_csv(const std::vector<ResponseSurface> &surfaces);

/// `front.csv`: a point a row, variables in their units, then all outputs.
CsvTable front_csv(const StudyFindings &findings);

/// `robust.csv`: source, output, nominal, mean, error, deviation, error, then quantiles with their intervals.
CsvTable robust_csv(const std::vector<RobustResult> &results);

} // namespace gestell::apps
