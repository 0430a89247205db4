#pragma once

#include <string>
#include <utility>

namespace gestell::apps
{

/// The remedy for a slip in a line that is not TOML, as "text stands in quotes: \"bdf\""; "": none is recognised.
std::string toml_hint(const std::string &line);
/// The same, or else from the reason that the TOML library gives; never empty.
std::string toml_hint(const std::string &line, const std::string &reason);

/// The remedy for a number that the TOML library does not take because it is too large; "": that is not the reason.
std::string hint_of_large_number(const std::string &reason);

/// Error of a file before TOML parsing, with its line: the text is not UTF-8, or is CAD; else "".
std::pair<int, std::string> hint_of_bytes(const std::string &text);

} // namespace gestell::apps
