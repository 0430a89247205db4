#pragma once

#include "coupling/substructures/frame_of_parts.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Checks joints without a mesh: unknown ends, joints of a part with itself, two joints of one interface, parts without
/// a joint, flexible faces without a joint or with a face of another kind.
/// @throws std::invalid_argument with the location of the joint.
void require_joints(const FrameOfParts &description);

/// Rejects two interfaces of a joint that are farther apart than the tolerance [m].
void require_meeting(const FrameJoint &joint, const Eigen::Vector3d &first, const Eigen::Vector3d &second,
                     double tolerance);

/// The same of all joints whose interfaces have positions.
/// @param diagonals  of the boxes around the parts [m]; 0: unknown.
void require_meeting(const FrameOfParts &description, const std::vector<double> &diagonals);

/// Allowed distance of the nodes of a joint [m]: its own value, or a thousandth of the larger part.
double tolerance_of(const FrameJoint &joint, const FrameOfParts &description, const std::vector<double> &diagonals);

} // namespace gestell::coupling
