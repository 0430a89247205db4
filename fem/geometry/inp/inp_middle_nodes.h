#pragma once

#include "fem/values/vector3.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Puts the middle nodes of quadratic cells into Abaqus's order, edge by edge.
 *
 * Programs use different orders. Each node is assigned to the edge with the nearest midpoint (its own edge in a tie),
 * and all cells of a kind must have the same order.
 */
class InpMiddleNodes
{
public:
  explicit InpMiddleNodes(std::function<Vector3(std::size_t)> position) : position_(std::move(position)) {}

  /// Orders the middle nodes of a cell, corners first; false: not on edges, or in another order than before.
  bool order(int gmsh_type, std::vector<std::size_t> &nodes);

  /// Notes on kinds whose middle nodes were not in Abaqus's order.
  std::vector<std::string> notes() const;

private:
  std::vector<std::size_t> edges_of(int gmsh_type, const std::vector<std::size_t> &nodes) const;
  double                   nearby(std::size_t node, std::size_t a, std::size_t b) const;

  std::function<Vector3(std::size_t)>     position_; ///< position of a node by its number
  std::map<int, std::vector<std::size_t>> order_of_; ///< kind to the edges of its middle nodes
};

} // namespace gestell::fem
