#include "fem/mesh/size_field.h"

#include "fem/values/vector3.h"

#include <cmath>

namespace gestell::fem
{

SizeField::SizeField(std::vector<SizePoint> points, double otherwise)
    : points_(std::move(points)), otherwise_(otherwise), width_(otherwise)
{
  for (std::size_t i = 0; i < points_.size(); ++i)
    bins_[key(bin(points_[i].at))].push_back(static_cast<int>(i));
}

std::array<int, 3> SizeField::bin(const Vector3 &x) const
{
  return {static_cast<int>(std::floor(x[0] / width_)), static_cast<int>(std::floor(x[1] / width_)),
          static_cast<int>(std::floor(x[2] / width_))};
}

std::uint64_t SizeField::key(const std::array<int, 3> &bin)
{
  constexpr std::int64_t half = 1 << 20; // three bins of 21 bits, from -2^20
  const auto             part = [&](int i) { return static_cast<std::uint64_t>(i + half) & (2 * half - 1); };
  return part(bin[0]) << 42 | part(bin[1]) << 21 | part(bin[2]);
}

double SizeField::operator()(const Vector3 &x) const
{
  const auto centre = bin(x);
  double     sum = 0., weights = 0.;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (const auto found = bins_.find(key({centre[0] + i, centre[1] + j, centre[2] + k})); found != bins_.end())
          for (const int p : found->second)
          {
            const Vector3 r      = points_[p].at - x;
            const double  d2     = dot(r, r) / (points_[p].size * points_[p].size) + 1e-3;
            const double  weight = 1. / (d2 * d2);
            sum += weight * points_[p].size;
            weights += weight;
          }
  return weights > 0. ? sum / weights : otherwise_;
}

} // namespace gestell::fem
