#pragma once

#include "coupling/eigensolvers/slepc/petsc_objects.h"
#include "fem/parallel/ranks.h"
#include "fem/values/sparse_matrix.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdio>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/// Rows of a sparse matrix.
struct SparseRowBlock
{
  std::vector<int>    begin{0}, column;
  std::vector<double> value;
};

struct CloseFile
{
  void operator()(std::FILE *file) const { std::fclose(file); }
};
using StoredRows = std::unique_ptr<std::FILE, CloseFile>; ///< deleted when it is closed

/**
 * The free coordinates of a frame on rank 0 as rows of PETSc: in the order of nested dissection, an interval per
 * rank, which is half as long for rank 0, so that few couplings cross ranks.
 *
 * Every function but the first four is collective.
 */
class RowDistribution
{
public:
  /// @param A     of rank 0: square, both triangles, compressed; its pattern gives the order.
  /// @param held  of rank 0, ascending.
  RowDistribution(const fem::Ranks &ranks, const Eigen::SparseMatrix<double> *A, const std::vector<int> &held);

  int size() const { return begin_.back(); }          ///< rows of all
  int first() const { return begin_[ranks_.rank()]; } ///< row of this rank
  int owned() const { return begin_[ranks_.rank() + 1] - first(); }
  int coordinates() const { return n_; } ///< the fixed ones included

  /// A(free, free) of a matrix on rank 0.
  PetscOwned<Mat> distributed(const Eigen::SparseMatrix<double> *A) const;
  /// Back: the matrix on rank 0 [n x n], zero in the fixed coordinates.
  Eigen::SparseMatrix<double> collected(Mat A) const;

  /// The rows of A on the disks of their computers, in the folder for temporary files, and A again; none if a disk does
  /// not take them.
  StoredRows      stored(Mat A) const;
  PetscOwned<Mat> loaded(const StoredRows &rows) const;

  /// Own rows of X [n x k] on rank 0, and back: fixed coordinates become zero.
  Eigen::MatrixXd deal_out(const Eigen::Ref<const Eigen::MatrixXd> &X, int columns) const;
  void            collect(const Eigen::Ref<const Eigen::MatrixXd> &rows, Eigen::Ref<Eigen::MatrixXd> X) const;

private:
  PetscOwned<Mat> made_of(const SparseRowBlock &own) const;
  Eigen::MatrixXd rows_of(int rank, const Eigen::Ref<const Eigen::MatrixXd> &X) const;

  fem::Ranks       ranks_;
  int              n_ = 0;
  std::vector<int> begin_; ///< first row of each rank
  std::vector<int> order_; ///< rank 0: coordinate of every row
};

/**
 * The rows of this rank and copies of those that its own are coupled to (ghosts, which follow the own ones).  A matrix
 * becomes a sum of the ranks' parts: a coupling of two ranks counts half on each.
 */
class LocalRows
{
public:
  /// @param matrices  of RowDistribution::distributed(), with all couplings between them.
  LocalRows(const RowDistribution &rows, const std::vector<Mat> &matrices);

  int owned() const { return owned_; }
  int count() const { return owned_ + int(ghosts_.size()); }
  /// Row among those of all.
  int row_of(int local) const { return local < owned_ ? first_ + local : ghosts_[local - owned_]; }

  /// The part of this rank, symmetric.
  fem::SparseMatrix part_of(Mat A) const;

  /// Own rows of Y <- Y + A X: see exact_product().
  void add_product(Mat A, const Eigen::MatrixXd &X, Eigen::MatrixXd &Y) const;

  /// Copies the values of ghosts from their ranks; adds the values at ghosts to their ranks.  The rows of X lie one
  /// after the other, `width` numbers each.
  void complete(double *X, int width) const;
  void add_up(double *X, int width) const;

private:
  int local(int row) const;

  int                 first_, owned_;
  std::vector<int>    ghosts_; ///< rows, ascending
  PetscOwned<PetscSF> exchange_;
};

} // namespace gestell::coupling
