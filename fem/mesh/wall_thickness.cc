#include "fem/mesh/wall_thickness.h"

#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace gestell::fem
{

namespace
{

struct Triangle
{
  Vector3 a, b, c;

  Vector3 twice_area() const { return cross(b - a, c - a); }
  Vector3 middle() const { return (1. / 3.) * (a + b + c); }
  double  longest_side() const { return std::max({norm(b - a), norm(c - b), norm(a - c)}); }
};

/// Distance at which the ray from x along the unit vector d meets the triangle from inside; infinite if not.
double meeting(const Triangle &triangle, const Vector3 &x, const Vector3 &d)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const Vector3    u = triangle.b - triangle.a, v = triangle.c - triangle.a, n = cross(u, v);
  const double     facing  = dot(n, d);
  constexpr double grazing = 0.5; // cosine: sides of a wall are nearly parallel, its edges are not
  if (facing < grazing * norm(n))
    return none;
  const double  t     = dot(n, triangle.a - x) / facing;
  const Vector3 r     = x + t * d - triangle.a;
  const double  area2 = dot(n, n), beta = dot(cross(r, v), n) / area2, gamma = dot(cross(u, r), n) / area2;
  return t > 0. && beta >= -1e-9 && gamma >= -1e-9 && beta + gamma <= 1. + 1e-9 ? t : none;
}

/// Triangles by the cubes of a lattice they may touch.
class Bins
{
public:
  Bins(const std::vector<Triangle> &triangles, double width) : width_(width)
  {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      visit(box({triangles[t].a, triangles[t].b, triangles[t].c}),
            [&](std::uint64_t key) { bins_[key].push_back(static_cast<int>(t)); });
  }

  /// Calls action(triangle) for all that may meet the segment; some more than once.
  template <typename Action>
  void along(const Vector3 &from, const Vector3 &to, const Action &action) const
  {
    visit(box({from, to, to}),
          [&](std::uint64_t key)
          {
            if (const auto found = bins_.find(key); found != bins_.end())
              for (const int t : found->second)
                action(t);
          });
  }

private:
  using Box = std::pair<std::array<int, 3>, std::array<int, 3>>;

  Box box(const std::array<Vector3, 3> &points) const
  {
    Box result;
    for (int d = 0; d < 3; ++d)
    {
      const auto [low, high] = std::minmax({points[0][d], points[1][d], points[2][d]});
      result.first[d]        = static_cast<int>(std::floor(low / width_));
      result.second[d]       = static_cast<int>(std::floor(high / width_));
    }
    return result;
  }

  template <typename Action>
  static void visit(const Box &box, const Action &action)
  {
    constexpr std::int64_t half = 1 << 20; // three bins of 21 bits, from -2^20
    for (std::int64_t i = box.first[0]; i <= box.second[0]; ++i)
      for (std::int64_t j = box.first[1]; j <= box.second[1]; ++j)
        for (std::int64_t k = box.first[2]; k <= box.second[2]; ++k)
          action(static_cast<std::uint64_t>(i + half) << 42 | static_cast<std::uint64_t>(j + half) << 21 |
                 static_cast<std::uint64_t>(k + half));
  }

  double                                              width_;
  std::unordered_map<std::uint64_t, std::vector<int>> bins_;
};

/// The value below which `share` of the weight lies; each pair is value and weight.
double quantile(std::vector<std::pair<double, double>> weighted, double share)
{
  if (weighted.empty())
    return 0.;
  std::sort(weighted.begin(), weighted.end());
  double total = 0.;
  for (const auto &entry : weighted)
    total += entry.second;
  double below = 0.;
  for (const auto &[value, weight] : weighted)
    if ((below += weight) >= share * total)
      return value;
  return weighted.back().first;
}

} // namespace

WallThickness wall_thickness(const Mesh &mesh)
{
  std::vector<Triangle> triangles;
  double                sides = 0.;
  for (const auto &[a, b, c] : mesh.skin)
  {
    triangles.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    sides += triangles.back().longest_side() / static_cast<double>(mesh.skin.size());
  }
  const Bins bins(triangles, sides);

  double                                 area = 0., thin = 0.;
  std::vector<std::pair<double, double>> thicknesses, ratios; // with the area for which they apply
  for (const Triangle &triangle : triangles)
  {
    const Vector3 normal = triangle.twice_area();
    const double  own = 0.5 * norm(normal), size = triangle.longest_side();
    const Vector3 inward = -1. * unit(normal), from = triangle.middle();
    double        nearest = std::numeric_limits<double>::infinity();
    bins.along(from, from + size * inward,
               [&](int t) { nearest = std::min(nearest, meeting(triangles[t], from, inward)); });
    area += own;
    if (nearest > size)
      continue;
    thin += own;
    thicknesses.emplace_back(nearest, own);
    ratios.emplace_back(size / nearest, own);
  }
  constexpr double percentile = 0.05; // of the skin: the thinnest wall that is more than an edge
  return {quantile(thicknesses, percentile), quantile(ratios, 0.5), area > 0. ? thin / area : 0.};
}

} // namespace gestell::fem
