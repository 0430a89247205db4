#pragma once

#include "apps/scene/language/quantity.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// All units of scene files by name, with their SI values.
const std::map<std::string, Quantity> &units();

std::vector<std::string> unit_names();

/// "r", "rev", "U": a revolution of a shaft; a unit only before "/min" and other times, if the name is free.
const std::map<std::string, Quantity> &turn_units();

/// Proposals for a name that is not a unit, the most likely first: mm^2 for "mm2", N mm for "Nmm"; then units with a
/// similar spelling.
std::vector<std::string> units_meant(const std::string &name);

} // namespace gestell::apps
