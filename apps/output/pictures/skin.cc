#include "apps/output/pictures/skin.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

Vector3d normal(const Skin &skin, const std::array<int, 3> &t)
{
  const Vector3d &a = skin.points[t[0]];
  return (skin.points[t[1]] - a).cross(skin.points[t[2]] - a).normalized();
}

/// The plane of a face, roughly: where it looks, and its distance from the origin.
using Plane = std::array<long, 4>;

/// Numbers of the planes of the faces around every point, ascending: one inside a plane, two on an edge, three at a
/// corner.
std::vector<std::vector<long>> planes_of(const Skin &skin, double tolerance)
{
  std::map<Plane, long>          numbers;
  std::vector<std::vector<long>> planes(skin.points.size());
  for (const auto &t : skin.triangles)
  {
    const Vector3d n      = normal(skin, t);
    const double   level  = n.dot(skin.points[t[0]]);
    const Plane    plane  = {std::lround(2. * n[0]), std::lround(2. * n[1]), std::lround(2. * n[2]),
                             std::lround(level / tolerance)};
    const long     number = numbers.emplace(plane, long(numbers.size())).first->second;
    for (const int i : t)
      if (auto &own = planes[i]; std::find(own.begin(), own.end(), number) == own.end())
        own.push_back(number);
  }
  for (std::vector<long> &own : planes)
    std::sort(own.begin(), own.end());
  return planes;
}

/// Group number of every point, in order of first occurrence: one group has one grid cell and the same planes.
std::vector<int> groups_of(const Skin &skin, double edge)
{
  std::vector<std::vector<long>>   keys = planes_of(skin, 0.25 * edge);
  std::map<std::vector<long>, int> numbers;
  std::vector<int>                 group;
  group.reserve(skin.points.size());
  for (std::size_t i = 0; i < skin.points.size(); ++i)
  {
    const Vector3d place = skin.points[i] / edge;
    keys[i].insert(keys[i].begin(), {std::lround(place[0]), std::lround(place[1]), std::lround(place[2])});
    group.push_back(numbers.emplace(std::move(keys[i]), static_cast<int>(numbers.size())).first->second);
  }
  return group;
}

} // namespace

double Skin::size() const
{
  if (points.empty())
    return 0.;
  Vector3d low = points.front(), high = low;
  for (const Vector3d &x : points)
  {
    low  = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).norm();
}

double Skin::largest_displacement() const
{
  double largest = 0.;
  for (const Vector3d &u : displacement)
    largest = std::max(largest, u.norm());
  return largest;
}

CoarseMesh coarse_mesh(const Skin &skin, double edge)
{
  if (skin.points.empty())
    return {};
  const std::vector<int> group    = groups_of(skin, edge);
  const std::size_t      n_groups = static_cast<std::size_t>(*std::max_element(group.begin(), group.end())) + 1;

  std::vector<Vector3d> mean(n_groups, Vector3d::Zero());
  std::vector<int>      count(n_groups, 0), nearest(n_groups, -1);
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    mean[group[i]] += skin.points[i];
    ++count[group[i]];
  }
  const auto distance = [&](std::size_t i) { return (skin.points[i] - mean[group[i]] / count[group[i]]).norm(); };
  for (std::size_t i = 0; i < group.size(); ++i)
    if (int &best = nearest[group[i]]; best < 0 || distance(i) < distance(static_cast<std::size_t>(best)))
      best = static_cast<int>(i);

  CoarseMesh coarse;
  coarse.points = nearest;
  for (std::size_t i = 0; i < skin.triangles.size(); ++i)
  {
    const auto              &t = skin.triangles[i];
    const std::array<int, 3> c = {group[t[0]], group[t[1]], group[t[2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
      continue;
    coarse.triangles.push_back(c);
    coarse.source.push_back(static_cast<int>(i));
  }
  return coarse;
}

std::vector<std::array<int, 2>> sharp_edges(const Skin &skin, double degrees)
{
  const double cosine = std::cos(degrees * 3.14159265358979323846 / 180.);
  struct Edge
  {
    std::array<int, 2> ends;
    Vector3d           first_normal;
    int                n_triangles;
    bool               drawn;
  };
  std::unordered_map<long, Edge> edges;
  for (const auto &t : skin.triangles)
  {
    const Vector3d n = normal(skin, t);
    for (int i = 0; i < 3; ++i)
    {
      const int  a = std::min(t[i], t[(i + 1) % 3]), b = std::max(t[i], t[(i + 1) % 3]);
      const long key   = static_cast<long>(a) * static_cast<long>(skin.points.size()) + b;
      const auto found = edges.emplace(key, Edge{{a, b}, n, 0, false}).first;
      if (++found->second.n_triangles > 1 && n.dot(found->second.first_normal) < cosine)
        found->second.drawn = true;
    }
  }
  std::vector<std::array<int, 2>> drawn;
  for (const auto &[key, edge] : edges)
    if (edge.drawn || edge.n_triangles == 1)
      drawn.push_back(edge.ends);
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

} // namespace gestell::apps
