#pragma once

#include "apps/scene/file/scene_node.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Adds a change of a key; it replaces an earlier change of the same key, or enters a table among the changes.
void add_change(std::vector<SceneNode::Entry> &changes, const std::string &key, const SceneNode &value);

/// A value as TOML on one line.
/// @param text_of  text to write for a string value; null: the string
std::string written_value(const SceneNode &value, std::string (*text_of)(const SceneNode &) = nullptr);

/// The same with the absolute path of a file that a text names.
std::string portable_value(const SceneNode &node);

/// A scene file that extends another by changes.  Its path is relative to `folder`, the folder of the new file.
/// @param comment  first line of the file
std::string extending_scene(const std::string &comment, const std::string &file,
                            const std::vector<SceneNode::Entry> &changes, const std::filesystem::path &folder);

} // namespace gestell::apps
