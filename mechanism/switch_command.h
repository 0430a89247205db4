#pragma once

#include <limits>
#include <string>

namespace gestell::mechanism
{

/**
 * Command of a switch to an element.
 *
 *     "off", "on"   its force is zero; it acts again from its initial state
 *     "start"       its profile begins now
 *     "hold"        its level stays
 *     "set"         a ramp to `level` begins within the limits `rate` and `rate_of_rate`
 *     "brake"       the same to zero
 */
struct SwitchCommand
{
  std::string name;
  double      level        = 0.;
  double      rate         = std::numeric_limits<double>::infinity(); ///< per second, > 0
  double      rate_of_rate = std::numeric_limits<double>::infinity(); ///< per second squared, > 0
};

} // namespace gestell::mechanism
