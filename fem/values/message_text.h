#pragma once

#include "fem/values/vector3.h"

#include <string>

namespace gestell::fem
{

/// Number for messages: five digits, without noise around zero.
std::string text(double value);
std::string text(const Vector3 &v); ///< "(0 0 0.9)"

} // namespace gestell::fem
