#pragma once

#include "coupling/algebra/large_array.h"
#include "coupling/algebra/triangular_solve_kernels.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace gestell::coupling
{

/**
 * A few long columns, X [n x columns], stored for products: in panels of as many columns as the processor handles
 * together (fewer for few columns), in which the numbers of a row are adjacent.  Rows beyond n, up to a multiple of
 * eight and at least one, and unused columns are zero.
 */
class MultiVector
{
public:
  MultiVector() = default;
  MultiVector(int n, int columns);

  int rows() const { return n_; }
  int columns() const { return columns_; }
  int n_tiles() const { return (n_ + 8) / 8; } ///< groups of eight rows
  int n_panels() const { return int(panels_.size()); }

  const BlockAlgebra &algebra() const { return *algebra_; }
  int                 lanes() const { return algebra_->columns; }                  ///< columns of a panel
  std::ptrdiff_t tile_step() const { return std::ptrdiff_t(tile_rows) * lanes(); } ///< numbers in eight of its rows

  double       *panel(int p) { return panels_[p].data(); }
  const double *panel(int p) const { return panels_[p].data(); }

  double &operator()(int i, int j);
  double  operator()(int i, int j) const { return const_cast<MultiVector &>(*this)(i, j); }

  /// X(k, :) <- Y(order[k], :), and back; the numbers of columns must agree.
  void take(const Eigen::Ref<const Eigen::MatrixXd> &Y, const std::vector<int> &order);
  void give(Eigen::Ref<Eigen::MatrixXd> Y, const std::vector<int> &order) const;

  /// X <- X F, F [columns x k], k <= columns.
  void transform(const Eigen::MatrixXd &F);

private:
  int                     n_ = 0, columns_ = 0;
  const BlockAlgebra     *algebra_ = &block_algebra(0);
  std::vector<LargeArray> panels_;
};

/// X^T Y; both with panels of as many lanes.
Eigen::MatrixXd gram(const MultiVector &X, const MultiVector &Y);

/// A sparse matrix with rows and columns in another order; equal rows of a node are stored once.
class ReorderedMatrix
{
public:
  /// A(order, order), A symmetric with both triangles stored; rows and columns of `held` (ascending) count as zero.
  ReorderedMatrix(const Eigen::SparseMatrix<double> &A, const std::vector<int> &order, const std::vector<int> &held);

  /// Y <- A X; Y has the size of X.
  void multiply(const MultiVector &X, MultiVector &Y) const;

private:
  int                 n_;
  std::vector<int>    first_, begin_, column_; // as SparseRows
  std::vector<double> value_;
};

/// Q [n x columns], to which columns are added in blocks.
class KrylovBasis
{
public:
  explicit KrylovBasis(int n) : n_(n) {}

  int columns() const { return columns_; }

  void append(const MultiVector &X);

  /// Q(:, from ...)^T X; `from` is the start of a block.
  Eigen::MatrixXd project(const MultiVector &X, int from = 0) const;
  /// X -= Q(:, from ...) H
  void subtract(MultiVector &X, const Eigen::MatrixXd &H, int from = 0) const;

  /// Q <- Q S, S [columns x k], k <= columns.
  void transform(const Eigen::MatrixXd &S);

  /// V(order[i], :) <- (Q S)(i, :)
  void give(const Eigen::MatrixXd &S, const std::vector<int> &order, Eigen::MatrixXd &V) const;

private:
  struct Part
  {
    LargeArray tiles;           // of eight rows and `width` columns
    int        width, used = 0; // columns
  };

  std::size_t     part_at(int column) const;
  Eigen::MatrixXd rows_of_parts(const Eigen::MatrixXd &H, std::size_t first_part) const; // zeros for columns not used
  void subtract_strip(const BlockAlgebra &algebra, std::size_t first_part, int first, int count, const double *H,
                      double *X) const;
  /// Calls visit(first tile, number of tiles, row) for Q S, row(i, j) being its entries there.
  template <typename Visit>
  void for_each_product(const Eigen::MatrixXd &S, const Visit &visit) const;
  int  n_tiles() const { return (n_ + 8) / 8; }

  int               n_, columns_ = 0;
  std::vector<Part> parts_;
};

} // namespace gestell::coupling
