#include "coupling/frame/face_reach.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::Matrix3d;
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

/// Directions of the sides, orthogonal; a side of length zero has the remaining direction.
Matrix3d axes_of(const FaceBox &box)
{
  Matrix3d axes = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    axes.col(k) = box.half.col(k).normalized();
  for (int k = 0; k < 3; ++k)
    if (axes.col(k).isZero(0.))
    {
      const Vector3d one = axes.col((k + 1) % 3), other = axes.col((k + 2) % 3);
      axes.col(k) = one.isZero(0.)     ? other.unitOrthogonal()
                    : other.isZero(0.) ? one.unitOrthogonal()
                                       : one.cross(other);
    }
  return axes;
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

FaceReach reach_of(const FaceBox &box, const Vector3d &point, const Matrix3d &free)
{
  // Alternating projections on two convex sets, the box and the free points: they converge to the nearest points.
  constexpr int projections = 100;
  if (box.half.isZero(0.))
    return {};
  Vector3d x = point;
  for (int i = 0; i < projections; ++i)
    x = point + free * (nearest_in(box, x) - point);
  const Vector3d sides   = 2. * box.half.colwise().norm().transpose(),
                 lever   = axes_of(box).transpose() * (x - nearest_in(box, x));
  constexpr double flat  = 1e-3; // of sides: CAD kernels widen boxes by 1e-7 m
  const bool       plane = sides.minCoeff() <= flat * sides.maxCoeff();
  FaceReach        worst;
  for (int along = 0; along < 3; ++along)
  {
    int k = (along + 1) % 3, l = (along + 2) % 3;
    if (sides[k] < sides[l])
      std::swap(k, l);
    constexpr double elongated = 2.; // sides of a view of bores in line, longer than one bore is wide
    const bool       in_line   = sides[k] >= elongated * sides[l] && std::abs(lever[k]) > std::abs(lever[l]);
    const FaceReach  seen{std::hypot(lever[k], lever[l]), sides[k], plane || in_line ? far_from_faces : far_from_bore};
    if (seen.size > 0. &&
        (worst.size == 0. || seen.outside * worst.size * worst.limit > worst.outside * seen.size * seen.limit))
      worst = seen;
  }
  return worst;
}

} // namespace gestell::coupling
