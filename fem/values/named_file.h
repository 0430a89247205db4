#pragma once

#include <filesystem>
#include <string>

namespace gestell::fem
{

/// Why the file system cannot resolve a name, as the end of a sentence that begins with it: the name is too long, its
/// links form a loop, a folder of it is not accessible. "" if it can.
std::string why_unreachable(const std::filesystem::path &name);

/// Kind of file system entry: "a folder", "a device", "a pipe"; "" for a regular file or none.
std::string other_than_file(const std::filesystem::path &name);

/// Whether a name, or the target of its link, exists.
/// @throws std::invalid_argument with why_unreachable()
bool names_something(const std::filesystem::path &name);

} // namespace gestell::fem
