#pragma once

#include "apps/analysis/comparison/run_comparison.h"
#include "apps/output/report/section.h"

namespace gestell::apps
{

/// The signals that two runs share, a chart for each of the first few: full lines of the first run, dashed ones of the
/// other; of forces that are shaken once more around the main shock of the first.
std::vector<Section::Drawing> overlay_charts(const std::string &scene, const coupling::RunResult &run,
                                             const ComparedRun &other);

} // namespace gestell::apps
