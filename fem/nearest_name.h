#pragma once

#include <string>
#include <vector>

namespace gestell::fem
{

/// "the nearest names are "feet", "face", "table"": at most three of the known names, for a message.
/// @param what  the known names stand for, "surface"
std::string nearest_names(const std::string &name, const std::vector<std::string> &known,
                          const std::string &what = "surface");

} // namespace gestell::fem
