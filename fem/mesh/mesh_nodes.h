#pragma once

#include "fem/values/mesh.h"

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// Pairs of points no further apart than the distance [m], each point with the nearest earlier one.
std::vector<std::pair<int, int>> coincident(const std::vector<Point3> &points, double distance);

/// Nodes of gmsh's mesh, numbered as points in the order in which cells use them.
class MeshNodes
{
public:
  /**
   * @param unit  length of gmsh's unit [m]
   * @param gap   nodes within this distance [m] are merged; 0: none
   * @param head  prefix of messages
   * @throws std::invalid_argument if a coordinate is not finite.
   */
  MeshNodes(double unit, double gap, const std::string &head);

  /// Index of the point in `points`, to which new nodes are appended.
  /// @param head  prefix of the message if the node is not in the mesh (std::invalid_argument)
  int index(std::size_t tag, std::vector<Point3> &points, const std::string &head);

  /// Position of a node that does not become a point, such as the middle of an edge.
  Point3 position(std::size_t tag, const std::string &head) const;

  /// Index of a node that a cell uses, -1 for others.
  int index(std::size_t tag) const;

  /// gmsh's tag of each point.
  const std::vector<std::size_t> &tags() const { return tags_; }

  std::size_t n_unused() const; ///< nodes without a cell of any order
  std::size_t n_merged() const { return same_as_.size(); }

private:
  std::size_t representative(std::size_t tag) const;

  std::unordered_map<std::size_t, Point3>      position_;
  std::unordered_map<std::size_t, std::size_t> same_as_; // merged nodes
  std::unordered_map<std::size_t, int>         index_;
  std::vector<std::size_t>                     tags_;
};

} // namespace gestell::fem
