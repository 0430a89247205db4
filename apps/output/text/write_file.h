#pragma once

#include <filesystem>
#include <string>

namespace gestell::apps
{

/// Makes a file that is whole or not there.  @throws std::runtime_error with path and reason.
void write_file(const std::filesystem::path &path, const std::string &content);

} // namespace gestell::apps
