#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * The files that a scene is read from: the scene file, those it extends, and those that its keys name (CAD with all
 * files that a script includes, meshes, matrices, tables).  Results must not replace them.
 *
 * @param overrides  of the command line, "key.path=value"
 * @return only the file itself if it cannot be read as a scene
 */
std::vector<std::filesystem::path> input_files(const std::string &file, const std::vector<std::string> &overrides);

} // namespace gestell::apps
