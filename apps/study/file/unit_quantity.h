#pragma once

#include "apps/scene/language/quantity.h"

#include <string>

namespace gestell::apps
{

/// A value in its unit as expressions know it; of any dimension (not checked) if the unit is none they know.
Quantity quantity_in_unit(double value, const std::string &unit);

} // namespace gestell::apps
