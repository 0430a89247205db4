#pragma once

#include "coupling/modes/modes_along.h"

#include <cstddef>

namespace gestell::apps
{

/// What a line does over all positions.
struct LineExtremes
{
  double min = 0., x_min = 0., max = 0., x_max = 0.; ///< undamped frequency [Hz]
  double least_damping = 0., largest_damping = 0.;   ///< ratios; nan where it never vibrates
  double growth = 0., x_growth = 0.;                 ///< largest [1/s], and where
  double least_assurance = 0.;                       ///< of the tracking; nan with one position
};
LineExtremes line_extremes(const coupling::ModesAlong &along, std::size_t line);

} // namespace gestell::apps
