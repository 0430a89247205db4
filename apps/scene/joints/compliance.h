#pragma once

#include "apps/scene/joints/joint_type.h"
#include "mechanism/joints/compliant_joint.h"

#include <optional>

namespace gestell::apps
{

/// Keys of joints that can be compliant: `stiffness`, `damping`, and those for rotations.
const std::vector<Key> &compliance_keys();

/// None if none of the keys is given.
/// @throws std::invalid_argument for joints that do not connect two markers, and values without any stiffness
std::optional<ComplianceRequest> read_compliance(const SceneTable &table, const JointType &type);

/// Which body carries the directions of a compliant point.
mechanism::RelativeMeasure::Carrier carrier_of(const JointRequest &joint, const Pair &pair);

/// The joint with a spring and a damper in place of each of its equations.
std::shared_ptr<mechanism::CompliantJoint> compliant_joint(const JointRequest &joint, const JointEquations &equations,
                                                           Pair &pair);

} // namespace gestell::apps
