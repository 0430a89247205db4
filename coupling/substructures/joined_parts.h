#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/substructures/frame_of_parts.h"
#include "coupling/substructures/joint_preload.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Parts of a frame in one set of coordinates: interfaces, and the modes of the parts.
struct JoinedParts
{
  fem::FrameMatrices        matrices; ///< its interfaces are the retained ones
  ReducedFrame              facts;    ///< facts about the whole: sizes, mass, notes; no matrices
  Eigen::VectorXd           left_out; ///< [p] errors of its frequencies: errors_by_modes_left_out()
  std::vector<JointPreload> preloads;
};

/**
 * Joins parts at their interfaces.
 *
 * The coordinates of all parts, q = G q_j, follow from those q_j of the joined frame: at a weld the second
 * interface moves with the first, u_2 = u_1 + theta_1 x (x_2 - x_1), theta_2 = theta_1.  Bolts and tie rods are springs
 * between interfaces:
 *
 *     M = G^T diag(M_i) G + rods,   C = G^T (diag(C_i) + sum R^T K R) G,   R q the motion of the second end against
 *     the first at the point of the joint.
 *
 * q = 0 is the frame with tightened rods.  A joint's force on its second part is the residual of the equation of motion
 * without its springs:
 *
 *     f_2 = M_2. q'' + B_2. q' + C_2. q - f_g + preload,
 *
 * in the rows of the second interface; loads of the mechanism there act on the first part.
 *
 * @param parts  in their positions (placed()), in the order of the description.
 * @throws std::invalid_argument with the location of the joint: unknown ends, joints of a part with itself, two joints
 *         of one interface, interfaces too far apart, parts without a joint.
 *
 * Source: Craig & Bampton 1968; docs/theory/substructures.md.
 */
JoinedParts join_parts(const std::vector<ReducedFrame> &parts, const FrameOfParts &description);

/// Options for the reduction of the joined frame to the retained interfaces: those of its parts, or all modes.
ReductionOptions joined_options(const FrameOfParts &frame, const JoinedParts &joined, ReductionOptions options);

/// The joined frame after its reduction, with the known facts about its parts.
ReducedFrame completed(ReducedFrame reduced, const JoinedParts &joined);

} // namespace gestell::coupling
