#include "fem/values/triangle_surface.h"

#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace gestell::fem
{

namespace
{

using Edge = std::pair<int, int>;

Edge edge(const std::array<int, 3> &triangle, int i)
{
  return {triangle[i], triangle[(i + 1) % 3]};
}

Edge reversed(const Edge &e)
{
  return {e.second, e.first};
}

double volume_of(const TriangleSurface &surface, const std::vector<int> &triangles)
{
  double V = 0.;
  for (const int t : triangles)
  {
    const auto &[a, b, c] = surface.triangles[t];
    V += dot(surface.points[a] - surface.points[0],
             cross(surface.points[b] - surface.points[0], surface.points[c] - surface.points[0])) /
         6.;
  }
  return V;
}

std::vector<int> all(const TriangleSurface &surface)
{
  std::vector<int> triangles(surface.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    triangles[t] = static_cast<int>(t);
  return triangles;
}

/// The triangles connected to the first one, oriented like it.
std::vector<int> shell_of(TriangleSurface &surface, int first, const std::map<Edge, std::vector<int>> &around,
                          std::vector<bool> &visited)
{
  std::vector<int> shell = {first};
  visited[first]         = true;
  for (std::size_t next = 0; next < shell.size(); ++next)
  {
    const std::array<int, 3> here = surface.triangles[shell[next]];
    for (int i = 0; i < 3; ++i)
    {
      const Edge e = edge(here, i);
      for (const int other : around.at(std::minmax(e.first, e.second)))
      {
        if (visited[other])
          continue;
        auto &triangle = surface.triangles[other];
        for (int j = 0; j < 3; ++j)
          if (edge(triangle, j) == e)
          {
            std::swap(triangle[1], triangle[2]);
            break;
          }
        visited[other] = true;
        shell.push_back(other);
      }
    }
  }
  return shell;
}

} // namespace

double enclosed_volume(const TriangleSurface &surface)
{
  return surface.points.empty() ? 0. : volume_of(surface, all(surface));
}

int unmatched_edges(const TriangleSurface &surface)
{
  std::map<Edge, int> count;
  for (const auto &triangle : surface.triangles)
    for (int i = 0; i < 3; ++i)
      ++count[edge(triangle, i)];
  int unmatched = 0;
  for (const auto &[e, n] : count)
  {
    const auto back = count.find(reversed(e));
    unmatched += n != 1 || back == count.end() || back->second != 1;
  }
  return unmatched;
}

void turn_outwards(TriangleSurface &surface)
{
  std::map<Edge, std::vector<int>> around;
  for (const int t : all(surface))
    for (int i = 0; i < 3; ++i)
    {
      const Edge e = edge(surface.triangles[t], i);
      around[std::minmax(e.first, e.second)].push_back(t);
    }
  std::vector<bool>             visited(surface.triangles.size(), false);
  std::vector<std::vector<int>> shells;
  std::vector<double>           volumes;
  for (const int t : all(surface))
    if (!visited[t])
    {
      shells.push_back(shell_of(surface, t, around, visited));
      volumes.push_back(volume_of(surface, shells.back()));
    }
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto outer  = std::max_element(volumes.begin(), volumes.end(), larger) - volumes.begin();
  for (std::size_t i = 0; i < shells.size(); ++i)
    if ((volumes[i] > 0.) != (static_cast<long>(i) == outer))
      for (const int t : shells[i])
        std::swap(surface.triangles[t][1], surface.triangles[t][2]);
}

namespace
{

using Eigen::Vector3d;

Vector3d nearest_on_segment(const Vector3d &x, const Vector3d &a, const Vector3d &b)
{
  return a + std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.) * (b - a);
}

} // namespace

// The foot of the perpendicular if it lies inside; otherwise the nearest point of the three edges.
Vector3d nearest_on_triangle(const Vector3d &x, const std::array<Vector3d, 3> &corners)
{
  const auto &[a, b, c]    = corners;
  const Vector3d n         = (b - a).cross(c - a).normalized();
  const Vector3d foot      = x - n.dot(x - a) * n;
  const auto     is_inside = [&](const Vector3d &p, const Vector3d &q) { return (q - p).cross(foot - p).dot(n) >= 0.; };
  if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a))
    return foot;
  Vector3d best = nearest_on_segment(x, a, b);
  for (const Vector3d &other : {nearest_on_segment(x, b, c), nearest_on_segment(x, c, a)})
    if ((other - x).squaredNorm() < (best - x).squaredNorm())
      best = other;
  return best;
}

} // namespace gestell::fem
