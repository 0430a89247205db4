#pragma once

#include "coupling/substructures/frame_of_parts.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Refuses what can be said against joints without any mesh: unknown ends, joints of a part with itself, two joints of
/// one interface, parts that nothing joins.
/// @throws std::invalid_argument, headed with the joint's place.
void require_joints(const FrameOfParts &description);

/// Refuses two interfaces of a joint that are farther apart than the tolerance [m].
void require_meeting(const FrameJoint &joint, const Eigen::Vector3d &first, const Eigen::Vector3d &second,
                     double tolerance);

/// The same of all joints whose interfaces have positions, within a hundredth of their distances in a part where no
/// tolerance is given: what is far off.
void require_meeting(const FrameOfParts &description);

} // namespace gestell::coupling
