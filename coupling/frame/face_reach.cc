#include "coupling/frame/face_reach.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::Vector3d;

/// The point of the box nearest to x.
Vector3d nearest_in(const FaceBox &box, const Vector3d &x)
{
  Vector3d nearest = box.centre;
  for (int k = 0; k < 3; ++k)
    if (const Vector3d half = box.half.col(k); !half.isZero(0.))
      nearest += std::clamp((x - box.centre).dot(half) / half.squaredNorm(), -1., 1.) * half;
  return nearest;
}

} // namespace

FaceBox box_of(const fem::PlaneFace &face)
{
  if (!face.known())
    return {face.centre, face.axes};
  FaceBox box{face.centre, Eigen::Matrix3d::Zero()};
  for (int k = 0; k < 2; ++k)
    box.half.col(k) = face.half[k] * face.axes.col(k);
  return box;
}

FaceBox box_between(const Vector3d &low, const Vector3d &high)
{
  return {0.5 * (low + high), (0.5 * (high - low)).asDiagonal()};
}

FaceReach reach_of(const FaceBox &box, const Vector3d &point, const Eigen::Matrix3d &free)
{
  // Alternates between the box and the points that are free, two convex sets: it closes in on where they are nearest.
  constexpr int projections = 100;
  if (box.half.isZero(0.))
    return {};
  Vector3d x = point;
  for (int i = 0; i < projections; ++i)
    x = point + free * (nearest_in(box, x) - point);
  return {(x - nearest_in(box, x)).norm(), 2. * box.half.colwise().norm().maxCoeff()};
}

} // namespace gestell::coupling
