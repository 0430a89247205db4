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
/// A box with sides along the global axes.
FaceBox box_between(const Eigen::Vector3d &low, const Eigen::Vector3d &high);

/**
 * Limits of outside/size, beyond which a point is far from its faces.  Faces that carry a load at their two ends react
 * to a force F at the distance e outside of them with F (1 + e/s) at the near end and -F e/s at the far end.  Brackets
 * on plane faces and shafts in two aligned bores have such a tensile reaction: at e = s/2 it reaches half of F.  Next
 * to a bore, which should contain a pin, the limit is a quarter of F.
 */
constexpr double far_from_faces = 0.5, far_from_bore = 0.25;

/**
 * A point near the faces of an interface, in the view along the side of the box in which it appears farthest away: a
 * force normal to this view has the lever `outside`, and the faces resist its moment over the length `size`.
 */
struct FaceReach
{
  double outside = 0.;             ///< [m] from the rectangle around them in that view; 0: within it, or unknown
  double size    = 0.;             ///< [m] longer side of this rectangle
  double limit   = far_from_faces; ///< of outside/size

  bool far() const { return outside > limit * size; }
};

/// @param free  projector onto directions in which the point can be shifted without effect, as along a guide.
FaceReach reach_of(const FaceBox &box, const Eigen::Vector3d &point,
                   const Eigen::Matrix3d &free = Eigen::Matrix3d::Zero());

} // namespace gestell::coupling
