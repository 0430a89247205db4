#pragma once

#include <string>

namespace gestell::apps
{

/// A string in TOML syntax: quoted, on one line.
std::string written_text(const std::string &text);

/// A number for messages; for an expression with its value: "m3, which is -3200 in SI units".
std::string with_value(const std::string &text, double value);

} // namespace gestell::apps
