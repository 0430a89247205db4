#pragma once

#include <string>

namespace gestell::mechanism
{

/// A quantity set from time to time by programs coupled with the machine, extrapolated linearly in between: x(t) =
/// value + rate (t - since).  In the SI unit of the quantity.
struct InputValue
{
  std::string name;
  double      value = 0.;
  double      rate  = 0.; ///< [1/s]
  double      since = 0.; ///< [s]

  double at(double t) const { return value + rate * (t - since); }
};

} // namespace gestell::mechanism
