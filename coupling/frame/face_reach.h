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

/**
 * Shares of the size s of faces, outside of which a point is far.  Faces that carry at their two ends take a force F at
 * the distance e outside of them as F (1 + e/s) at the near end and -F e/s at the far one.  Brackets on plane faces and
 * shafts in two bores in line have such a pull: from e = s/2 on it counts as much as half of F.  Beside a bore, in
 * which a pin belongs, a quarter of F does.
 */
constexpr double far_from_faces = 0.5, far_from_bore = 0.25;

/**
 * A point beside the faces of an interface, seen along that side of the box from which it looks farthest off: a force
 * across this view has the lever `outside`, and the faces resist its moment over `size`.
 */
struct FaceReach
{
  double outside = 0.; ///< [m] from the rectangle around them in that view; 0: within, or they are not known
  double size    = 0.; ///< [m] longer side of this rectangle
  double limit   = far_from_faces; ///< of outside/size

  bool far() const { return outside > limit * size; }
};

/// @param free  projector onto directions in which the point may be moved, as along the axis of a guide.
FaceReach reach_of(const FaceBox &box, const Eigen::Vector3d &point,
                   const Eigen::Matrix3d &free = Eigen::Matrix3d::Zero());

} // namespace gestell::coupling
