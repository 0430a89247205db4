#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace gestell::fem
{

/// Cells with the same number of nodes.
struct NodeLists
{
  const int  *nodes; ///< cell after cell
  std::size_t n_cells;
  int         n_nodes; ///< of a cell

  NodeLists(const int *nodes_of_cells, std::size_t count, int n) : nodes(nodes_of_cells), n_cells(count), n_nodes(n) {}
  template <std::size_t n>
  NodeLists(const std::vector<std::array<int, n>> &cells)
      : nodes(cells.empty() ? nullptr : cells[0].data()), n_cells(cells.size()), n_nodes(int(n))
  {
  }
};

} // namespace gestell::fem
