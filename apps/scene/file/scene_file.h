#pragma once

#include "apps/scene/file/scene_node.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Reads a scene file with the files that it extends, and applies the overrides.
 *
 * `extends = "other.toml"` in a file inherits the keys of the other file.  If both define a key, tables are merged; for
 * any other value the extending file wins.  Paths are relative to the file that contains them.
 *
 * @param overrides  "key.path=value"; segments with spaces or dots in quotes.  The value is parsed as TOML if possible,
 *                   else it is a string: run.step=20 us and run.step="20 us" are the same.  Relative paths in a value
 *                   are relative to the working directory.
 * @throws std::invalid_argument with file and line.
 */
SceneNode read_scene_file(const std::string &path, const std::vector<std::string> &overrides);

/// The same for a scene without a file, as if it were in this file.
SceneNode with_extended(const SceneNode &own, const std::string &path);

} // namespace gestell::apps
