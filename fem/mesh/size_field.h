#pragma once

#include "fem/values/vector3.h"

#include <Eigen/Core>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace gestell::fem
{

/// Target size of the elements at a point [m].
struct SizePoint
{
  Vector3 at;
  double  size;
};

/// Element size [m] at any point, interpolated from sizes at scattered points, weighted by distance.
class SizeField
{
public:
  /// @param points  if empty, the size is `otherwise` everywhere; it is also used far from all points.
  SizeField(std::vector<SizePoint> points, double otherwise);

  double operator()(const Vector3 &x) const;

private:
  std::array<int, 3>   bin(const Vector3 &x) const;
  static std::uint64_t key(const std::array<int, 3> &bin);

  std::vector<SizePoint>                              points_;
  double                                              otherwise_, width_; // of the bins
  std::unordered_map<std::uint64_t, std::vector<int>> bins_;
};

} // namespace gestell::fem
