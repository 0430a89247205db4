#pragma once

#include <string>

namespace gestell::mechanism
{

/// A quantity that whoever couples the machine with other programs sets from time to time; in between it goes on along
/// a straight line:   x(t) = value + rate (t - since).  In the unit of the quantity that it is, in SI.
struct InputValue
{
  std::string name;
  double      value = 0.;
  double      rate  = 0.; ///< [1/s]
  double      since = 0.; ///< [s]

  double at(double t) const { return value + rate * (t - since); }
};

} // namespace gestell::mechanism
