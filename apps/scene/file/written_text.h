#pragma once

#include <string>

namespace gestell::apps
{

/// Text as it must be written in TOML: in quotes, on one line.
std::string written_text(const std::string &text);

} // namespace gestell::apps
