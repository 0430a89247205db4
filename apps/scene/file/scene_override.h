#pragma once

#include "apps/scene/file/scene_node.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Sets one key: "key.path=value", see read_scene_file().
void apply_override(SceneNode &root, const std::string &text);
/// The key and the value of "key.path=value".
std::pair<std::string, SceneNode> parsed_override(const std::string &text);
/// apply_override() for a value that was parsed elsewhere; messages contain its location.
void apply_override(SceneNode &root, const std::string &key, const SceneNode &value);

/// Keys of a table; null: none.
std::vector<std::string> names_in(const SceneNode *table);

/// Segments of  frame.surface."crown bearing left".faces .
std::vector<std::string> key_segments(const std::string &key, const Place &place);

} // namespace gestell::apps
