#pragma once

#include <string>

namespace gestell::apps
{

/// The way out of a slip in a line that is not TOML, as "text stands in quotes: \"bdf\""; empty if none is
/// recognised.
std::string toml_hint(const std::string &line);

} // namespace gestell::apps
