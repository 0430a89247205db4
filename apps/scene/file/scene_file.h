#pragma once

#include "apps/scene/file/scene_node.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Reads a scene file with all it extends and the overrides applied.
 *
 * `extends = "other.toml"` in a file takes over the entries of the other one; where both have one, tables are merged
 * and for anything else the extending file wins.  Paths stay relative to the file they are written in.
 *
 * @param overrides  "key.path=value"; segments with spaces or dots in quotes.  The value is read as TOML if it is
 *                   that, else it is text: run.step=20 us and run.step="20 us" are the same.  Relative paths in a value
 *                   are relative to the working directory.
 * @throws std::invalid_argument with file and line.
 */
SceneNode read_scene_file(const std::string &path, const std::vector<std::string> &overrides);

/// The same of a scene that is no file but stands as if it were this one.
SceneNode with_extended(const SceneNode &own, const std::string &path);

} // namespace gestell::apps
