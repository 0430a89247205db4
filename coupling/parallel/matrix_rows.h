#pragma once

#include "coupling/parallel/petsc_objects.h"
#include "fem/parallel/ranks.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

/// Which row of shared matrices every coordinate has: rows are numbered rank by rank, in the order of q on each.
struct RowPlan
{
  std::vector<int> begin;         // first row of each rank, and n
  std::vector<int> row_of;        // of each coordinate
  std::vector<int> coordinate_of; // of each row
};

/// @param rank_of the rank of each coordinate [n].
RowPlan plan_rows(const std::vector<int> &rank_of, int n_ranks);

/// Rows of a sparse matrix, compressed.
struct CompressedRows
{
  std::vector<int>    begin{0}, column; // entries of row i: from begin[i] to begin[i + 1]
  std::vector<double> value;

  int n_rows() const { return int(begin.size()) - 1; }
};

// Rows of a symmetric matrix, dealt out.  Columns are numbered as the rows of the plan, ascending.

/// This rank's rows of what rank 0 has; collective.  @param A nullptr on the ranks above 0.
CompressedRows dealt_out(const fem::Ranks &ranks, const Eigen::SparseMatrix<double> *A, const RowPlan &plan);

/// The symmetric matrix [n x n] whose rows the ranks have; collective.
PetscOwned<Mat> shared_matrix(const CompressedRows &rows, int n);

} // namespace gestell::coupling
