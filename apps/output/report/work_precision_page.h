#pragma once

#include "apps/output/charts/work_precision.h"

namespace gestell::apps
{

/// chart.html: the chart to look into, in one file without references to anything outside it.  Methods can be shown and
/// hidden, work counted in several ways; the pointer shows the settings of a run.  Without scripts it shows the
/// picture.
std::string work_precision_page(const WorkPrecision &chart);

} // namespace gestell::apps
