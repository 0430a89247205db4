#pragma once

#include "fem/assembly/node_lists.h"

#include <petscmat.h>

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * Symmetric PETSc matrix of dense blocks b x b between nodes (b = 1 or 3), local to this process.
 *
 * add() element matrices, then finish(), then read or add again and finish() again.
 */
class BlockMatrix
{
public:
  /// Allocates all pairs of nodes that share an element.
  BlockMatrix(int block_size, int n_nodes, const std::vector<NodeLists> &elements);
  ~BlockMatrix();
  BlockMatrix(BlockMatrix &&other) noexcept;
  BlockMatrix(const BlockMatrix &)            = delete;
  BlockMatrix &operator=(const BlockMatrix &) = delete;

  /// Adds a matrix [n b x n b], row-major; its pairs must be among those of the constructor.
  template <std::size_t n>
  void add(const std::array<int, n> &nodes, const double *values)
  {
    add(nodes.data(), static_cast<int>(n), values);
  }
  void add(const int *nodes, int n, const double *values);
  /// Adds one block [b x b] at the row and column of two nodes.
  void add_block(int row, int column, const double *values);
  void finish();

  int block_size() const { return block_size_; }
  int n_nodes() const { return n_nodes_; }

  /// Compressed block rows, columns ascending; blocks are stored by columns.  Valid until the next add().
  struct Rows
  {
    const int    *begin;   // [n_nodes + 1]
    const int    *columns; // [number of blocks]
    const double *values;  // [number of blocks * b * b]
  };
  Rows rows() const;

private:
  int block_size_, n_nodes_;
  Mat matrix_ = nullptr;
};

} // namespace gestell::fem
