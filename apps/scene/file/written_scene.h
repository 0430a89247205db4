#pragma once

#include "apps/scene/file/scene_node.h"

#include <string>

namespace gestell::apps
{

/// A table as TOML that reads back to the same values.
std::string written_scene(const SceneNode &root);

} // namespace gestell::apps
