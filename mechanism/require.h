#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace gestell::mechanism
{

/// Throws std::invalid_argument: "element: name = value, but needed".
inline void require(bool holds, const std::string &element, const std::string &name, double value,
                    const std::string &needed)
{
  if (holds)
    return;
  std::ostringstream message;
  message << element << ": " << name << " = " << value << ", but it must be " << needed;
  throw std::invalid_argument(message.str());
}

} // namespace gestell::mechanism
