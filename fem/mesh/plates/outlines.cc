#include "fem/mesh/plates/outlines.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace gestell::fem
{

namespace
{

constexpr int points_of_curves = 64; // that bound a face

bool is_line(int curve)
{
  std::string type;
  gmsh::model::getType(1, curve, type);
  return type == "Line";
}

/// Points along a curve, in n equal steps of its parameter [m].
std::vector<Vector3> points_along(int curve, double unit, int n)
{
  std::vector<double> low, high, at, x;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  for (int i = 0; i <= n; ++i)
    at.push_back(low[0] + (high[0] - low[0]) * i / n);
  gmsh::model::getValue(1, curve, at, x);
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < x.size(); i += 3)
    points.push_back(unit * Vector3{x[i], x[i + 1], x[i + 2]});
  return points;
}

std::vector<Point2> drawn_along(int curve, const DrawingPlane &plane, int n)
{
  const int           d = plane.direction;
  std::vector<Point2> points;
  for (const Vector3 &x : points_along(curve, plane.unit, n))
    points.push_back({dot(plane.axes[(d + 1) % 3], x), dot(plane.axes[(d + 2) % 3], x)});
  return points;
}

std::vector<int> ends_of(int curve)
{
  std::vector<int> above, points;
  gmsh::model::getAdjacencies(1, curve, above, points);
  return points;
}

/// Number of sides for the rotation of the tangent along an edge, as of a regular polygon, and for its length; even.
int sides_along(int edge, double unit, double longest)
{
  const std::vector<Vector3> x      = points_along(edge, unit, is_line(edge) ? 1 : points_of_curves);
  double                     length = 0., turn = 0.;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
  {
    length += norm(x[i + 1] - x[i]);
    if (i > 0)
      turn += std::acos(std::clamp(dot(fem::unit(x[i] - x[i - 1]), fem::unit(x[i + 1] - x[i])), -1., 1.));
  }
  constexpr int sides_of_circle = 16; // of the section of a hole: its area is 2.6 % small
  const double  pairs           = std::max(turn / (4. * std::acos(-1.) / sides_of_circle), 0.5 * length / longest);
  return 2 * std::max(1, static_cast<int>(std::ceil(pairs - 1e-3)));
}

double distance(const Point2 &a, const Point2 &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

} // namespace

std::vector<std::vector<int>> loops_of(const std::vector<int> &edges)
{
  std::vector<std::pair<std::set<int>, std::vector<int>>> loops; // ends, edges
  for (const int edge : edges)
  {
    std::pair<std::set<int>, std::vector<int>> joined;
    for (const int end : ends_of(edge))
      joined.first.insert(end);
    joined.second.push_back(edge);
    for (std::size_t i = 0; i < loops.size();)
      if (std::any_of(loops[i].first.begin(), loops[i].first.end(), [&](int p) { return joined.first.count(p) > 0; }))
      {
        joined.first.insert(loops[i].first.begin(), loops[i].first.end());
        joined.second.insert(joined.second.end(), loops[i].second.begin(), loops[i].second.end());
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(i));
      }
      else
        ++i;
    loops.push_back(std::move(joined));
  }
  std::vector<std::vector<int>> result;
  for (auto &loop : loops)
    result.push_back(std::move(loop.second));
  return result;
}

FaceLoop face_loop(const std::vector<int> &edges, const DrawingPlane &plane)
{
  FaceLoop loop{edges, {}};
  for (const int edge : edges)
  {
    const std::vector<Point2> points = drawn_along(edge, plane, is_line(edge) ? 1 : points_of_curves);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      loop.sides.push_back({points[i], points[i + 1]});
  }
  return loop;
}

Outline outline_of(const std::vector<int> &edges, const DrawingPlane &plane, double longest)
{
  std::vector<std::pair<std::vector<Point2>, int>> curves; // and their edges
  for (const int edge : edges)
    curves.emplace_back(drawn_along(edge, plane, sides_along(edge, plane.unit, longest)), edge);
  Outline outline;
  Point2  end = outline.min = outline.max = curves.front().first.front();
  while (!curves.empty())
  {
    const auto apart = [&](const auto &curve)
    { return std::min(distance(curve.first.front(), end), distance(curve.first.back(), end)); };
    const auto next =
        std::min_element(curves.begin(), curves.end(), [&](auto &a, auto &b) { return apart(a) < apart(b); });
    auto &points = next->first;
    if (distance(points.back(), end) < distance(points.front(), end))
      std::reverse(points.begin(), points.end());
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      outline.sides.push_back({end, points[i]});
      outline.edge.push_back(next->second);
      end = points[i];
      for (int k = 0; k < 2; ++k)
      {
        outline.min[k] = std::min(outline.min[k], end[k]);
        outline.max[k] = std::max(outline.max[k], end[k]);
      }
    }
    curves.erase(next);
  }
  outline.sides.back()[1] = outline.sides.front()[0]; // equal up to rounding
  return outline;
}

double corner_factor(double turn)
{
  return std::sqrt(turn / std::sin(turn));
}

Outline of_equal_area(const Outline &outline)
{
  std::vector<Point2> corners;
  const std::size_t   n = outline.sides.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t before = (i + n - 1) % n;
    const Point2      p = outline.sides[before][0], x = outline.sides[i][0], q = outline.sides[i][1];
    const double      u0 = x[0] - p[0], u1 = x[1] - p[1], v0 = q[0] - x[0], v1 = q[1] - x[1];
    const double      turn = std::abs(std::atan2(u0 * v1 - u1 * v0, u0 * v0 + u1 * v1));
    corners.push_back(x);
    constexpr double straight_line = 1e-5; // [rad]
    if (outline.edge[before] != outline.edge[i] || !(turn > straight_line))
      continue;
    const double chord = 0.5 * (std::hypot(u0, u1) + std::hypot(v0, v1)), radius = 0.5 * chord / std::sin(0.5 * turn);
    const double out[] = {x[0] - 0.5 * (p[0] + q[0]), x[1] - 0.5 * (p[1] + q[1])}, length = std::hypot(out[0], out[1]);
    for (int k = 0; k < 2; ++k)
      corners.back()[k] += (corner_factor(turn) - 1.) * radius * out[k] / length;
  }
  Outline result = outline;
  result.min = result.max = corners.front();
  for (std::size_t i = 0; i < n; ++i)
  {
    result.sides[i] = {corners[i], corners[(i + 1) % n]};
    for (int k = 0; k < 2; ++k)
    {
      result.min[k] = std::min(result.min[k], corners[i][k]);
      result.max[k] = std::max(result.max[k], corners[i][k]);
    }
  }
  return result;
}

std::vector<Point2> corners_of(const Outline &outline)
{
  std::vector<Point2> corners;
  for (const Side &side : outline.sides)
    corners.push_back(side[0]);
  return corners;
}

bool is_inside(const std::vector<Side> &sides, const Point2 &x)
{
  bool inside = false;
  for (const auto &[a, b] : sides)
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
      inside = !inside;
  return inside;
}

} // namespace gestell::fem
