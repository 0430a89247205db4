#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/frame_of_parts.h"

namespace gestell::coupling
{

/**
 * A part placed in the frame: interface DOFs along the frame's axes, outputs and interfaces named after the part,
 * "crown.bearing".  Forces of supports keep the axes of the part.
 *
 *     u_part = Q^T u,   theta_part = det(Q) Q^T theta,   q_part = S q,   M <- S^T M S,   f_g <- S^T f_g Q^T
 *
 * (rotations are axial vectors: a mirror image reverses them).
 *
 * @param part  reduced in its own coordinates.
 * @throws std::invalid_argument if it is rotated while some DOFs of an interface are fixed.
 */
ReducedFrame placed(ReducedFrame part, const std::string &name, const Placement &placement);

/// All parts of a frame; messages begin with their place.
std::vector<ReducedFrame> all_placed(std::vector<ReducedFrame> parts, const FrameOfParts &frame);

/// S of a part in its own coordinates.
Eigen::MatrixXd turned_coordinates(const ReducedFrame &part, const Eigen::Matrix3d &Q);

} // namespace gestell::coupling
