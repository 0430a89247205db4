#pragma once

#include <string>
#include <vector>

namespace gestell::fem
{

/// "the nearest names are "feet", "face", "table"": at most three of the known names, for a message.
std::string nearest_names(const std::string &name, const std::vector<std::string> &known);

} // namespace gestell::fem
