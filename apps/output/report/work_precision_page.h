#pragma once

#include "apps/output/charts/work_precision.h"

namespace gestell::apps
{

/// chart.html: the interactive chart, in one file without external references.  Methods can be shown and hidden, and
/// work counted in several ways; a tooltip shows the settings of a run.  Without scripts it shows the picture.
std::string work_precision_page(const WorkPrecision &chart);

} // namespace gestell::apps
