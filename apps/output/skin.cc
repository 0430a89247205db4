#include "apps/output/skin.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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

/// The directions, roughly rounded, in which the faces around every point look: one on a plane, two on an edge, three
/// at a corner.
std::vector<std::set<std::array<int, 3>>> looks_of(const Skin &skin)
{
  std::vector<std::set<std::array<int, 3>>> looks(skin.points.size());
  for (const auto &t : skin.triangles)
  {
    const Vector3d           n       = normal(skin, t);
    const std::array<int, 3> rounded = {static_cast<int>(std::lround(2. * n[0])),
                                        static_cast<int>(std::lround(2. * n[1])),
                                        static_cast<int>(std::lround(2. * n[2]))};
    for (const int i : t)
      looks[i].insert(rounded);
  }
  return looks;
}

/// Number of the group of every point, numbered as they are met: points in one cell of a grid with the same looks.
std::vector<int> groups_of(const Skin &skin, double edge)
{
  using Key        = std::pair<std::array<long, 3>, std::set<std::array<int, 3>>>;
  const auto looks = looks_of(skin);

  std::map<Key, int> numbers;
  std::vector<int>   group;
  group.reserve(skin.points.size());
  for (std::size_t i = 0; i < skin.points.size(); ++i)
  {
    const Vector3d place = skin.points[i] / edge;
    const Key      key   = {{std::lround(place[0]), std::lround(place[1]), std::lround(place[2])}, looks[i]};
    group.push_back(numbers.emplace(key, static_cast<int>(numbers.size())).first->second);
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

Skin coarsened(const Skin &skin, double edge)
{
  if (skin.points.empty() || !(edge > 0.))
    return skin;
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

  Skin coarse;
  for (const int i : nearest)
  {
    coarse.points.push_back(skin.points[i]);
    coarse.displacement.push_back(skin.displacement[i]);
  }
  for (const auto &t : skin.triangles)
  {
    const std::array<int, 3> c = {group[t[0]], group[t[1]], group[t[2]]};
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
      coarse.triangles.push_back(c);
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
    bool               sharp;
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
        found->second.sharp = true;
    }
  }
  std::vector<std::array<int, 2>> sharp;
  for (const auto &[key, edge] : edges)
    if (edge.sharp || edge.n_triangles == 1)
      sharp.push_back(edge.ends);
  std::sort(sharp.begin(), sharp.end());
  return sharp;
}

} // namespace gestell::apps
