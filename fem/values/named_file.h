#pragma once

#include <filesystem>
#include <string>

namespace gestell::fem
{

/// Why the file system does not say whether anything stands under a name, as the end of a sentence that begins with it:
/// it is too long, its links lead round in a ring, a folder of it may not be entered.  "" if it says so.
std::string why_unreachable(const std::filesystem::path &name);

/// What stands under a name, in words: "a folder", "a device", "a pipe"; "" for an ordinary file or nothing.
std::string other_than_file(const std::filesystem::path &name);

/// Whether anything stands under a name, or under the one its link leads to.
/// @throws std::invalid_argument with why_unreachable()
bool names_something(const std::filesystem::path &name);

} // namespace gestell::fem
