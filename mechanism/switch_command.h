#pragma once

#include <limits>
#include <string>

namespace gestell::mechanism
{

/**
 * What a switch tells an element to do.
 *
 *     "off", "on"   its force is zero; it acts, beginning anew
 *     "start"       its profile begins now
 *     "hold"        the level it has stays
 *     "set"         a ramp begins that takes its level to `level` within the limits `rate` and `rate_of_rate`
 *     "brake"       likewise, to zero
 */
struct SwitchCommand
{
  std::string name;
  double      level        = 0.;
  double      rate         = std::numeric_limits<double>::infinity(); ///< per second, > 0
  double      rate_of_rate = std::numeric_limits<double>::infinity(); ///< per second squared, > 0
};

} // namespace gestell::mechanism
