#pragma once

#include "coupling/modes/modes_along.h"

#include <cstddef>

namespace gestell::apps
{

/// Extremes of a tracked mode over all positions.
struct LineExtremes
{
  double min = 0., x_min = 0., max = 0., x_max = 0.; ///< undamped frequency [Hz]
  double least_damping = 0., largest_damping = 0.;   ///< damping ratios; nan if it vibrates nowhere
  double growth = 0., x_growth = 0.;                 ///< largest growth rate [1/s], and its position
  double least_assurance = 0.;                       ///< of the mode tracking; nan with one position
};
LineExtremes line_extremes(const coupling::ModesAlong &along, std::size_t line);

} // namespace gestell::apps
