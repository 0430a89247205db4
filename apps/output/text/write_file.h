#pragma once

#include <filesystem>
#include <string>

namespace gestell::apps
{

/// Writes a file that appears complete or not at all.  @throws std::runtime_error with path and reason.
void write_file(const std::filesystem::path &path, const std::string &content);

} // namespace gestell::apps
