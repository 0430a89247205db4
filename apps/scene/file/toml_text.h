#pragma once

#include "apps/scene/file/scene_node.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// Scene file as a table.  @throws std::invalid_argument with file and line if it cannot be read or is not TOML.
SceneNode parse_toml_file(const std::string &path);

/// The same of a text; messages call it `name`.
/// @param folder  where relative paths in it start
SceneNode parse_toml_text(const std::string &text, const std::string &name, const std::string &folder);

/// One value in TOML's notation, at `place`; empty if `text` is no such value.
std::optional<SceneNode> parse_toml_value(const std::string &text, const Place &place, const std::string &folder);

} // namespace gestell::apps
