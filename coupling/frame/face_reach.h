#pragma once

#include "fem/values/face_fields.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Box around the faces of an interface.
struct FaceBox
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m]
  Eigen::Matrix3d half   = Eigen::Matrix3d::Zero(); ///< columns: half of each side [m], at right angles; zero: unknown
};

FaceBox box_of(const fem::PlaneFace &face);
/// Along the axes of space.
FaceBox box_between(const Eigen::Vector3d &low, const Eigen::Vector3d &high);

/// A point beside the faces of an interface.
struct FaceReach
{
  double outside = 0.; ///< [m] from the box around them; 0: within it, or they are not known
  double size    = 0.; ///< [m] longest side of the box
};

/// @param free  projector onto directions in which the point may be moved, as along the axis of a guide.
FaceReach reach_of(const FaceBox &box, const Eigen::Vector3d &point,
                   const Eigen::Matrix3d &free = Eigen::Matrix3d::Zero());

/**
 * Share of the size of faces, outside of which a point is far: faces of the size s take a force F at the distance e as
 * F and, by its moment, as forces of about F e / s.  From e = s / 2 on, with half of s within the faces, these and the
 * deflections that go with them are as large as those of F itself.
 */
constexpr double far_from_faces = 0.5;

} // namespace gestell::coupling
