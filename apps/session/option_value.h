#pragma once

#include "apps/scene/language/quantity.h"

#include <string>

namespace gestell::apps
{

/// The value of an option of the command line, "2.4 m" or a plain number in SI units.
/// @throws std::invalid_argument "--from: ..."
double option_value(const std::string &option, const std::string &text, const Kind &kind);

} // namespace gestell::apps
