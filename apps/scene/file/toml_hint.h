#pragma once

#include <string>
#include <utility>

namespace gestell::apps
{

/// Remedy for a typing error in a line that is not TOML, "text stands in quotes: \"bdf\""; empty: none recognised.
std::string toml_hint(const std::string &line);
/// The same, or a remedy for the reason that the TOML library gives; never empty.
std::string toml_hint(const std::string &line, const std::string &reason);

/// Remedy for a number that is too large for the TOML library; empty for other reasons.
std::string hint_of_large_number(const std::string &reason);

/// Error of a file before TOML parsing, with its line: the text is not UTF-8, or is CAD; else "".
std::pair<int, std::string> hint_of_bytes(const std::string &text);

} // namespace gestell::apps
