#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/joints/motion_law.h"

#include <memory>

namespace gestell::apps
{

/// A motion over time: `speed`, constant with a `brake` or a profile, or `function` or `table` of the time.
std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns);

/// Keys that it asks for.
std::vector<Key> motion_law_keys();

} // namespace gestell::apps
