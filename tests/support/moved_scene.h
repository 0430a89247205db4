#pragma once

#include "tests/support/restated_scene.h"

#include <Eigen/Core>

namespace gestell::tests
{

/// x -> R x + shift of space with all that is in it; R is orthogonal, a mirror if its determinant is -1.
struct RigidMotion
{
  Eigen::Matrix3d R     = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(); ///< [m]
  double          noise = 0.; ///< [m] by which each component of each point is moved at most, at random
  unsigned        seed  = 0;  ///< of that

  bool mirrors() const { return R.determinant() < 0.; }
};

/// A rotation at random, all equally probable; the same for a seed on every computer.
Eigen::Matrix3d random_rotation(unsigned seed);

/**
 * A scene moved as a whole, gravity too.
 *
 * Points move, directions turn, axes of rotation (axial vectors) keep their sense in a mirror; values in [start] and
 * signals along global axes become those of the moved machine.  Entries stay expressions of the scene's parameters.
 * Coordinates of a body in [start] of which some are given count as zero where they are not.
 *
 * Left out of the comparison: components of the forces of joints, which count along directions that each joint chooses,
 * and contact angles.
 *
 * Rows of a frame that belong to no interface are coordinates of modes and stay.
 *
 * @throws std::invalid_argument for what is bound to the global axes: frames of which not all three motions of each
 * interface are rows, frames from CAD, joints with a stiffness along each axis, unbalance; in a mirror screws
 */
Restated moved(const apps::SceneNode &scene, const RigidMotion &motion);

} // namespace gestell::tests
