#pragma once

#include "apps/scene/file/scene_node.h"

#include <string>

namespace gestell::apps
{

/// Sets one entry: "key.path=value", as explained at read_scene_file().
void apply_override(SceneNode &root, const std::string &text);

} // namespace gestell::apps
