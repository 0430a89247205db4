#pragma once

#include <string>
#include <utility>

namespace gestell::apps
{

/// The way out of a slip in a line that is not TOML, as "text stands in quotes: \"bdf\""; empty if none is
/// recognised.
std::string toml_hint(const std::string &line);

/// What the reason of the TOML library comes from, with the way out: a key or a table that stands twice; else "".
std::string hint_of_reason(const std::string &reason);
/// The same where the line itself tells nothing: an array that is not closed; else "".
std::string hint_of_place(const std::string &reason);

/// What is wrong with a file before it is read as TOML, and in which line: the text is not UTF-8, or is CAD; else "".
std::pair<int, std::string> hint_of_bytes(const std::string &text);

} // namespace gestell::apps
