#pragma once

#include "apps/scene/joints/joint_type.h"
#include "mechanism/joints/compliant_joint.h"

#include <optional>

namespace gestell::apps
{

/// Of joints that may yield: `stiffness`, `damping` and what is held of rotations.
const std::vector<Key> &compliance_keys();

/// None where none of them is given.
/// @throws std::invalid_argument for joints that do not hold two places, and values that hold nothing
std::optional<ComplianceRequest> read_compliance(const SceneTable &table, const JointType &type);

/// What carries the directions of a point that yields.
mechanism::RelativeMeasure::Carrier carrier_of(const JointRequest &joint, const Pair &pair);

/// The joint that is kept closed by springs and dampers, one for each of its equations.
std::shared_ptr<mechanism::CompliantJoint> compliant_joint(const JointRequest &joint, const JointEquations &equations,
                                                           Pair &pair);

} // namespace gestell::apps
