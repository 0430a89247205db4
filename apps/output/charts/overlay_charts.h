#pragma once

#include "apps/output/charts/signal_charts.h"
#include "apps/output/values/run_comparison.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The signals that two runs share, a chart for each of the first few: full lines of the first run, dashed ones of the
/// other; of forces that are shaken once more around the main shock of the first.
std::vector<SignalChart> overlay_charts(const std::string &scene, const coupling::RunResult &run,
                                        const ComparedRun &other);

} // namespace gestell::apps
