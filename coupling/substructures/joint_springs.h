#pragma once

#include "coupling/substructures/frame_of_parts.h"
#include "coupling/substructures/part_union.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Springs and dampers between two interfaces:  force on the second  f = -(K r + D r'),  where r = R q is its motion
 * relative to the first.
 *
 * Bolts: r [6] at the point x midway between the two interfaces; each bolt at x_i with stiffnesses k along the axes A
 * gives K += H_i^T A diag(k) A^T H_i,  with H_i the motion of x_i. Tie rod: r its elongation, K = E
 * A / L.
 */
struct JointSpring
{
  Eigen::MatrixXd R;    // [k x n]
  Eigen::MatrixXd K, D; // [k x k]
};

/// @throws std::invalid_argument for a tie rod with coinciding ends.
JointSpring spring_of(const FrameJoint &joint, const PartUnion &parts);

/// Unit elongation of a tie rod [n], d^T (u_2 - u_1), d from the first end to the second.
Eigen::VectorXd elongation(const FrameJoint &joint, const PartUnion &parts);

/// Geometric stiffness T / L (I - d d^T) of a tie rod of tension T between its ends [n x n].
Eigen::MatrixXd transverse_stiffness(const FrameJoint &joint, const PartUnion &parts);

/// Length of a tie rod [m]: the one given, or the distance of its ends.
double length_of(const FrameJoint &joint, const PartUnion &parts);

/// Half of the mass of a tie rod [kg] moves with each end.
double mass_of_rod(const FrameJoint &joint, const PartUnion &parts);

} // namespace gestell::coupling
