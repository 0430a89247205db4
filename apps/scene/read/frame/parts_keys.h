#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// Keys of [frame] of several parts; of [frame.part.NAME], with those of a frame from geometry; of [frame.joint.NAME].
const std::vector<Key> &parts_frame_keys();
const std::vector<Key> &frame_part_keys();
const std::vector<Key> &frame_joint_keys();

} // namespace gestell::apps
