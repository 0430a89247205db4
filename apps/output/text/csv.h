#pragma once

#include <string>

namespace gestell::apps
{

/// A field of a row (RFC 4180): in quotes where it holds a separator, a quote or a line end, its quotes doubled.
std::string csv_field(const std::string &text);

} // namespace gestell::apps
