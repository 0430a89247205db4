#pragma once

#include "apps/output/charts/work_precision.h"

namespace gestell::apps
{

/// Measure of the work of a run.
enum class WorkMeasure
{
  cpu,        ///< CPU time of the stepping thread [s]
  evaluations ///< of the element forces, or of the right-hand side in another solver
};
double work_of(const WorkPoint &point, WorkMeasure measure);

/// Error against work of one model, both logarithmic, one line per method: the better of its runs with events located
/// and skipped.  The colour shows the family, dashes and markers the method.
std::string work_precision_svg(const WorkPrecision &chart, int model, WorkMeasure measure);

/// Index of the colour class of a family.
int family_colour(const std::string &family);

} // namespace gestell::apps
