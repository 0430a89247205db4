#pragma once

#include <filesystem>

namespace gestell::apps
{

/// Writes the failure atlas to `file` (Markdown) and its figures into a folder beside it; returns an ExitCode.
int write_atlas(const std::filesystem::path &file, bool quiet);

} // namespace gestell::apps
