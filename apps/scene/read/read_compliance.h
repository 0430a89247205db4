#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

#include <optional>

namespace gestell::apps
{

/// `stiffness`, `damping` and what is held of rotations: with any of them the joint yields.
/// @throws std::invalid_argument for joints that do not hold two places, and values that hold nothing
std::optional<ComplianceRequest> read_compliance(const SceneTable &table, JointType type);

/// Of joints that may yield.
const std::vector<Key> &compliance_keys();

} // namespace gestell::apps
