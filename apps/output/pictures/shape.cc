#include "apps/output/pictures/shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::apps
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d on_circle(const Vector3d &e1, const Vector3d &e2, int i, int n)
{
  const double angle = 2. * M_PI * i / n;
  return std::cos(angle) * e1 + std::sin(angle) * e2;
}

/// Convex hull, counter-clockwise, by Andrew's monotone chain.
std::vector<Vector2d> hull(std::vector<Vector2d> points)
{
  std::sort(points.begin(), points.end(),
            [](const Vector2d &a, const Vector2d &b) { return std::pair(a[0], a[1]) < std::pair(b[0], b[1]); });
  std::vector<Vector2d> outline;
  for (int pass = 0; pass < 2; ++pass)
  {
    const std::size_t first = outline.size();
    for (const Vector2d &x : points)
    {
      const auto turns_left = [&](const Vector2d &a, const Vector2d &b)
      { return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) > 0.; };
      while (outline.size() >= first + 2 && !turns_left(outline[outline.size() - 2], outline.back()))
        outline.pop_back();
      outline.push_back(x);
    }
    outline.pop_back(); // begins the other half
    std::reverse(points.begin(), points.end());
  }
  return outline;
}

} // namespace

Vector3d across(const Vector3d &axis, const Vector3d &wish)
{
  const Vector3d part = wish - axis.dot(wish) * axis;
  return part.norm() > 1e-6 ? part.normalized() : axis.unitOrthogonal();
}

void add_box(Shape &shape, const Vector3d &centre, const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  const int first = static_cast<int>(shape.points.size());
  for (const double k : {-1., 1.})
    for (const auto &[i, j] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
      shape.points.push_back(centre + i * a + j * b + k * c);
  const auto quad = [&](int p, int q, int r, int s)
  {
    shape.triangles.push_back({first + p, first + q, first + r});
    shape.triangles.push_back({first + p, first + r, first + s});
  };
  quad(3, 2, 1, 0);
  quad(4, 5, 6, 7);
  for (int i = 0; i < 4; ++i)
    quad(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4);
}

void add_prism(Shape &shape, const std::vector<Vector3d> &outline, const Vector3d &half)
{
  const int first = static_cast<int>(shape.points.size()), n = static_cast<int>(outline.size());
  Vector3d  middle = Vector3d::Zero();
  for (const Vector3d &x : outline)
  {
    middle += x / n;
    shape.points.push_back(x - half);
    shape.points.push_back(x + half);
  }
  shape.points.push_back(middle - half);
  shape.points.push_back(middle + half);
  for (int i = 0; i < n; ++i)
  {
    const int here = first + 2 * i, next = first + 2 * ((i + 1) % n), hub = first + 2 * n;
    shape.triangles.push_back({here, next, next + 1});
    shape.triangles.push_back({here, next + 1, here + 1});
    shape.triangles.push_back({hub, next, here});
    shape.triangles.push_back({hub + 1, here + 1, next + 1});
  }
}

void add_disc(Shape &shape, const Vector3d &centre, const Vector3d &e1, const Vector3d &axis, double radius,
              double half_width)
{
  std::vector<Vector3d> rim;
  constexpr int         n_rim = 36; // corners of a disc: its rim is 0.4 % off a circle
  for (int i = 0; i < n_rim; ++i)
    rim.push_back(centre + radius * on_circle(e1, axis.cross(e1), i, n_rim));
  add_prism(shape, rim, half_width * axis);
}

void add_bar(Shape &shape, const Vector3d &a, const Vector3d &b, double radius, int n_corners)
{
  const Vector3d        half = 0.5 * (b - a), along = half.normalized(), e1 = across(along, Vector3d::UnitZ());
  std::vector<Vector3d> rim;
  for (int i = 0; i < n_corners; ++i)
    rim.push_back(a + half + radius * on_circle(e1, along.cross(e1), i, n_corners));
  add_prism(shape, rim, half);
}

void add_sphere(Shape &shape, const Vector3d &centre, double radius, int n_rings)
{
  const int first = static_cast<int>(shape.points.size()), n = 2 * n_rings;
  for (int j = 1; j < n_rings; ++j) // from the lower pole up
    for (int i = 0; i < n; ++i)
    {
      const double height = M_PI * j / n_rings;
      shape.points.push_back(centre +
                             radius * (std::sin(height) * on_circle(Vector3d::UnitX(), Vector3d::UnitY(), i, n) -
                                       std::cos(height) * Vector3d::UnitZ()));
    }
  const int low = static_cast<int>(shape.points.size()), high = low + 1;
  shape.points.push_back(centre - radius * Vector3d::UnitZ());
  shape.points.push_back(centre + radius * Vector3d::UnitZ());
  for (int i = 0; i < n; ++i)
  {
    const int k = (i + 1) % n;
    shape.triangles.push_back({low, first + k, first + i});
    for (int ring = first; ring < low - n; ring += n)
    {
      shape.triangles.push_back({ring + i, ring + k, ring + n + k});
      shape.triangles.push_back({ring + i, ring + n + k, ring + n + i});
    }
    shape.triangles.push_back({high, low - n + i, low - n + k});
  }
}

void add_plate(Shape &shape, const std::vector<Vector3d> &points, const Vector3d &n, double radius, double half_width)
{
  const Vector3d        e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  std::vector<Vector2d> flat;
  double                low = points.front().dot(n), high = low;
  for (const Vector3d &x : points)
  {
    low                    = std::min(low, x.dot(n));
    high                   = std::max(high, x.dot(n));
    constexpr int n_corner = 24; // of a full circle around a corner of a plate
    for (int i = 0; i < n_corner; ++i)
    {
      const Vector3d corner = x + radius * on_circle(e1, e2, i, n_corner);
      flat.emplace_back(corner.dot(e1), corner.dot(e2));
    }
  }
  std::vector<Vector3d> outline;
  for (const Vector2d &x : hull(flat))
    outline.push_back(x[0] * e1 + x[1] * e2 + 0.5 * (low + high) * n);
  add_prism(shape, outline, (0.5 * (high - low) + half_width) * n);
}

} // namespace gestell::apps
