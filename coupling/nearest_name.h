#pragma once

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The candidate with the smallest edit distance to `name`; empty if there are no candidates.
std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates);

} // namespace gestell::coupling
