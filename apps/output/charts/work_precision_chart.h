#pragma once

#include "apps/output/charts/work_precision.h"

namespace gestell::apps
{

/// What a run cost.
enum class WorkMeasure
{
  cpu,        ///< CPU time of the stepping thread [s]
  evaluations ///< of the elements' forces, or of a peer's right-hand side
};
double work_of(const WorkPoint &point, WorkMeasure measure);

/// Error against work of one model, both logarithmic, one line per method: the better of its runs with events located
/// and passed over.  Colours are families, dashes and markers the methods of one.
std::string work_precision_svg(const WorkPrecision &chart, int model, WorkMeasure measure);

/// Number of the colour class of a family.
int family_colour(const std::string &family);

} // namespace gestell::apps
