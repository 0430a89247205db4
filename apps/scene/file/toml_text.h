#pragma once

#include "apps/scene/file/scene_node.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// Scene file as a table.  @throws std::invalid_argument with file and line if it cannot be read or is not TOML.
SceneNode parse_toml_file(const std::string &path);

/// The same from a string; messages contain `name`.
/// @param folder  base of relative paths in it
SceneNode parse_toml_text(const std::string &text, const std::string &name, const std::string &folder);

/// One value in TOML syntax, at `place`; empty if `text` is not a value.
std::optional<SceneNode> parse_toml_value(const std::string &text, const Place &place, const std::string &folder);

} // namespace gestell::apps
