#pragma once

#include "coupling/parallel/matrix_rows.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

/**
 * C and M of a frame with their rows on all ranks, dealt out so that few entries join those of different ranks.
 *
 * Rows are numbered rank by rank; rank 0 alone knows the row of each coordinate of q.  Every function is collective;
 * vectors "on first" are rank 0's, in the order of q, and are not read on others.
 */
class SharedMatrices
{
public:
  /// Deals out what rank 0 has, both triangles stored; nullptr on the ranks above 0.
  SharedMatrices(const fem::Ranks &ranks, const Eigen::SparseMatrix<double> *C, const Eigen::SparseMatrix<double> *M);
  /// Matrices that all ranks have made.
  /// @param begin  first row of each rank, and n; on all ranks.
  /// @param row_of rank 0 alone.
  SharedMatrices(const fem::Ranks &ranks, std::vector<int> begin, std::vector<int> row_of, PetscOwned<Mat> C,
                 PetscOwned<Mat> M);

  const fem::Ranks &ranks() const { return ranks_; }
  Mat               C() const { return C_.get(); }
  Mat               M() const { return M_.get(); }
  int               n() const { return begin_.back(); }
  int               first_row() const { return begin_[ranks_.rank()]; }
  int               last_row() const { return begin_[ranks_.rank() + 1]; } ///< one beyond

  /// Rank 0: row of each coordinate; empty on others.
  const std::vector<int> &row_of() const { return row_of_; }
  /// The rows of coordinates that rank 0 names, ascending, on all ranks.
  std::vector<int> rows_of(const std::vector<int> *coordinates) const;

  PetscOwned<Vec> vector() const;
  void            deal_out(const double *on_first, Vec shared) const;
  void            collect(Vec shared, double *on_first) const;

private:
  fem::Ranks       ranks_;
  std::vector<int> begin_;  // first row of each rank, and n
  std::vector<int> row_of_; // rank 0
  PetscOwned<Mat>  C_, M_;
};

} // namespace gestell::coupling
