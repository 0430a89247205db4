#include "apps/output/values/line_extremes.h"

#include <cmath>

namespace gestell::apps
{

LineExtremes line_extremes(const coupling::ModesAlong &along, std::size_t line)
{
  LineExtremes own;
  own.min = own.least_damping = own.largest_damping = own.least_assurance = std::nan("");
  for (const coupling::ModesAt &at : along.positions)
  {
    if (line >= at.modes.size())
      continue;
    const coupling::Mode &mode = at.modes[line];
    if (std::isnan(own.min) || mode.frequency_hz < own.min)
    {
      own.min   = mode.frequency_hz;
      own.x_min = at.x;
    }
    if (mode.frequency_hz > own.max)
    {
      own.max   = mode.frequency_hz;
      own.x_max = at.x;
    }
    if (mode.growth > own.growth)
    {
      own.growth   = mode.growth;
      own.x_growth = at.x;
    }
    own.least_damping   = std::fmin(own.least_damping, mode.damping_ratio); // nan gives way
    own.largest_damping = std::fmax(own.largest_damping, mode.damping_ratio);
    if (line < at.assurance.size())
      own.least_assurance = std::fmin(own.least_assurance, at.assurance[line]);
  }
  return own;
}

} // namespace gestell::apps
