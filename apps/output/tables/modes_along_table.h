#pragma once

#include "apps/output/values/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::apps
{

/// modes_along.csv: one row per position and line, full precision, SI.
std::string modes_along_csv(const AlongResult &along);

/// modes_along_shapes.csv: the shapes to these rows, mass normalised, one column per coordinate of the machine.
std::string modes_along_shapes_csv(const AlongResult &along, const std::vector<std::string> &coordinates);

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
