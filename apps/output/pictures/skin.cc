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

/// The grid cell of a point and the numbers of the planes of the faces around it, ascending: one inside a plane, two on
/// an edge, three at a corner.
using GroupKey = std::vector<long>;

struct KeyHash
{
  std::size_t operator()(const GroupKey &key) const
  {
    std::size_t hash = 0;
    for (const long number : key)
      hash = (hash ^ std::size_t(number)) * 0x9E3779B97F4A7C15u + (hash >> 29u); // odd, from the golden ratio
    return hash;
  }
};

std::vector<GroupKey> keys_of(const Skin &skin, double edge)
{
  constexpr std::size_t cell = 3, usual = 6; // numbers of a cell, and of a key with three planes
  std::vector<GroupKey> keys(skin.points.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    keys[i].reserve(usual);
    for (const double x : skin.points[i])
      keys[i].push_back(std::lround(x / edge));
  }
  std::map<Plane, long> numbers;
  const double          tolerance = 0.25 * edge;
  for (const auto &t : skin.triangles)
  {
    const Vector3d n      = normal(skin, t);
    const double   level  = n.dot(skin.points[t[0]]);
    const Plane    plane  = {std::lround(2. * n[0]), std::lround(2. * n[1]), std::lround(2. * n[2]),
                             std::lround(level / tolerance)};
    const long     number = numbers.try_emplace(plane, long(numbers.size())).first->second;
    for (const int i : t)
      if (GroupKey &own = keys[i]; std::find(own.begin() + cell, own.end(), number) == own.end())
        own.push_back(number);
  }
  for (GroupKey &own : keys)
    std::sort(own.begin() + cell, own.end());
  return keys;
}

/// Group number of every point, in order of first occurrence: one group has one key.
std::vector<int> groups_of(const Skin &skin, double edge)
{
  std::unordered_map<GroupKey, int, KeyHash> numbers;
  std::vector<int>                           group;
  group.reserve(skin.points.size());
  for (GroupKey &key : keys_of(skin, edge))
    group.push_back(numbers.try_emplace(std::move(key), static_cast<int>(numbers.size())).first->second);
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
