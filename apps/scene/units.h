#pragma once

#include "apps/scene/quantity.h"

#include <map>
#include <string>

namespace gestell::apps
{

/// All units of scene files by name, as SI values.
const std::map<std::string, Quantity> &units();

} // namespace gestell::apps
