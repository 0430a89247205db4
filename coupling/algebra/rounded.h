#pragma once

#include <sstream>
#include <string>

namespace gestell::coupling
{

/// A number as notes and messages tell it.
inline std::string rounded(double value, int digits = 4)
{
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

inline std::string percent(double share, int digits = 3)
{
  return rounded(100. * share, digits) + " %";
}

} // namespace gestell::coupling
