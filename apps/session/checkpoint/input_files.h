#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * The files that a scene is read from: its own, those it extends, those that its entries name (CAD with all that a
 * script includes, meshes, matrices, tables), for folders in which no result may take their place.
 *
 * @param overrides  of the command line, "key.path=value"
 * @return the file alone where it cannot be read as a scene
 */
std::vector<std::filesystem::path> input_files(const std::string &file, const std::vector<std::string> &overrides);

} // namespace gestell::apps
