#pragma once

#include "coupling/substructures/frame_of_parts.h"
#include "coupling/substructures/joint_preload.h"
#include "coupling/substructures/joint_springs.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Matrices of the parts with the springs of joints and the masses of rods, before interfaces are welded.
struct SprungUnion
{
  Eigen::MatrixXd          M, B, C, load; // [n x n], [n x 3]
  std::vector<JointSpring> springs;       ///< of each joint; of welds empty
  Eigen::MatrixXd          tightening;    // [n] forces of tie rods on the parts at rest
};

SprungUnion sprung(const FrameOfParts &frame, const PartUnion &parts);

/// C with springs of its own size against the rigid motions that no support resists; forces in equilibrium do not load
/// them.
Eigen::MatrixXd held(const Eigen::MatrixXd &C, const Eigen::MatrixXd &rigid);

/**
 * Deflection q_0 [n] under the tensile forces of the rods, which are constant during tightening: of the parts, with
 * bolts and without the elasticity of rods,
 *
 *     (C - sum R_r^T K_r R_r) q_0 = f_0.
 *
 * @param rigid  [n_j x 6] rigid-body modes of the joined frame; f_0 does no work along them.
 */
Eigen::VectorXd tightened(const FrameOfParts &frame, const SprungUnion &sprung, const Eigen::MatrixXd &G,
                          const Eigen::MatrixXd &rigid);

/// The static preload of every joint: that matrix times q_0, less f_0, at the second interface.
/// @param rigid  see tightened().
std::vector<JointPreload> preloads_of(const FrameOfParts &frame, const PartUnion &parts, const SprungUnion &sprung,
                                      const Eigen::MatrixXd &G, const Eigen::MatrixXd &rigid);

/// Rows on q_j of the forces listed in joint_outputs().
std::vector<fem::FrameOutput> forces_of(const FrameJoint &joint, const PartUnion &parts, const SprungUnion &sprung,
                                        const JointSpring &spring, const Eigen::MatrixXd &G,
                                        const JointPreload &preload);

} // namespace gestell::coupling
