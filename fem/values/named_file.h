#pragma once

#include <filesystem>
#include <string>

namespace gestell::fem
{

/// Why the file system does not say whether there is anything under a name: it is too long, its links lead round in a
/// ring, a folder of it may not be entered; "" if it says so.
std::string unreachable(const std::filesystem::path &name);

/// Whether there is anything under a name.
/// @throws std::invalid_argument with the name and the reason, if it is unreachable()
bool is_there(const std::filesystem::path &name);

} // namespace gestell::fem
