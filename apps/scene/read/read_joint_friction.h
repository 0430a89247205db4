#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

#include <memory>

namespace gestell::apps
{

/// `friction` of the joints that slide along a surface; null without it.
std::shared_ptr<const JointFrictionRequest> read_joint_friction(const SceneTable &table, JointType type);

/// `friction` of a joint: a coefficient or its table.
Key joint_friction_key();

} // namespace gestell::apps
