#pragma once

#include <string>

namespace gestell::apps
{

/// Text as it must be written in TOML: in quotes, on one line.
std::string written_text(const std::string &text);

/// As messages quote a number: an expression tells its value, too: "m3, which is -3200 in SI units".
std::string with_value(const std::string &text, double value);

} // namespace gestell::apps
