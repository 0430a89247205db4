#include "fem/mesh/mesh_nodes.h"

#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_set>

namespace gestell::fem
{

namespace
{

/// A unit vector that is not perpendicular to any row of nodes in a usual mesh: the ratios of its components are not
/// those of small whole numbers.
constexpr Vector3 oblique = {0.43762743542266774, 0.5624637353870905, 0.7015103521258826};

} // namespace

// Points within the distance are also within it along any unit vector. After sorting along one, only points within a
// slab of that width are compared.
std::vector<std::pair<int, int>> coincident(const std::vector<Point3> &points, double distance)
{
  std::vector<double> along(points.size());
  std::transform(points.begin(), points.end(), along.begin(), [](const Point3 &p) { return dot(oblique, p); });
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return along[a] < along[b]; });
  double largest = 0.;
  for (const double height : along)
    largest = std::max(largest, std::abs(height));
  constexpr double rounding = 1e-14; // of a height along the vector, over the largest
  const double     slab     = distance + rounding * largest;

  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    int    nearest = -1;
    double least   = distance;
    for (std::size_t j = i; j-- > 0 && along[order[i]] - along[order[j]] <= slab;)
      if (const double apart = norm(points[order[i]] - points[order[j]]); apart <= least)
      {
        least   = apart;
        nearest = order[j];
      }
    if (nearest >= 0)
      pairs.emplace_back(nearest, order[i]);
  }
  return pairs;
}

MeshNodes::MeshNodes(double unit, double gap, const std::string &head)
{
  std::vector<std::size_t> all;
  std::vector<double>      coordinates, parameters;
  gmsh::model::mesh::getNodes(all, coordinates, parameters, -1, -1, false, false);
  std::vector<Point3> points;
  points.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    points.push_back(unit * Point3{coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
    if (!std::all_of(points.back().begin(), points.back().end(), [](double x) { return std::isfinite(x); }))
      throw std::invalid_argument(head + ": node " + std::to_string(all[i]) + " is at " + text(points.back()) +
                                  ", which is not a finite position; export the mesh again.");
    position_[all[i]] = points.back();
  }
  if (gap > 0.)
    for (const auto &[first, second] : coincident(points, gap))
      same_as_[all[second]] = all[first];
}

std::size_t MeshNodes::representative(std::size_t tag) const
{
  for (auto other = same_as_.find(tag); other != same_as_.end(); other = same_as_.find(tag))
    tag = other->second;
  return tag;
}

Point3 MeshNodes::position(std::size_t tag, const std::string &head) const
{
  const auto at = position_.find(tag);
  if (at == position_.end())
    throw std::invalid_argument(head + ": a cell has node " + std::to_string(tag) +
                                ", which is not in the file; export the mesh again, with all its nodes.");
  return at->second;
}

std::size_t MeshNodes::n_unused() const
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 3);
  std::unordered_set<std::size_t> used;
  for (const auto &of_type : nodes)
    used.insert(of_type.begin(), of_type.end());
  return static_cast<std::size_t>(
      std::count_if(position_.begin(), position_.end(), [&](const auto &node) { return used.count(node.first) == 0; }));
}

int MeshNodes::index(std::size_t tag, std::vector<Point3> &points, const std::string &head)
{
  tag                        = representative(tag);
  const auto [entry, is_new] = index_.try_emplace(tag, static_cast<int>(points.size()));
  if (is_new)
  {
    points.push_back(position(tag, head));
    tags_.push_back(tag);
  }
  return entry->second;
}

int MeshNodes::index(std::size_t tag) const
{
  const auto entry = index_.find(representative(tag));
  return entry == index_.end() ? -1 : entry->second;
}

} // namespace gestell::fem
