#pragma once

#include "apps/scene/language/quantity.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// All units of scene files by name, as SI values.
const std::map<std::string, Quantity> &units();

std::vector<std::string> unit_names();

/// "r", "rev", "U": a turn of a shaft; a unit in front of "/min" and other times only, where it is nothing else.
const std::map<std::string, Quantity> &turn_units();

/// Units that a name which is none may have been meant for, the most likely first: "mm2" is mm^2, "Nmm" is N mm; and
/// those that differ by a slip of the pen.
std::vector<std::string> units_meant(const std::string &name);

} // namespace gestell::apps
