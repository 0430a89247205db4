#pragma once

#include <string>
#include <utility>

namespace gestell::apps
{

/// Remedy for a typing error in a line that is not TOML, such as "text stands in quotes: \"bdf\""; empty if none is
/// recognised.
std::string toml_hint(const std::string &line);

/// Cause and remedy for a message of the TOML library: a key or a table that is defined twice; else "".
std::string hint_of_reason(const std::string &reason);
/// The same if the line itself gives no hint: an array that is not closed; else "".
std::string hint_of_place(const std::string &reason);

/// Error of a file before TOML parsing, with its line: the text is not UTF-8, or is CAD; else "".
std::pair<int, std::string> hint_of_bytes(const std::string &text);

} // namespace gestell::apps
