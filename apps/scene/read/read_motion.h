#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/joints/motion_law.h"

#include <memory>

namespace gestell::apps
{

/// Reads a motion over time: `speed`, constant with a `brake` or a profile, or `function` or `table` of time.
std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns);

/// Keys of read_motion().
std::vector<Key> motion_law_keys();

} // namespace gestell::apps
