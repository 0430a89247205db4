#pragma once

#include "coupling/reduction/petsc_objects.h"
#include "fem/part_sums.h"
#include "fem/ranks.h"

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

// Rows of a symmetric matrix, dealt out and collected.  Columns are numbered as the rows of the plan, ascending.

/// This rank's rows of what rank 0 has; collective.  @param A nullptr on the ranks above 0.
fem::CompressedRows dealt_out(const fem::Ranks &ranks, const Eigen::SparseMatrix<double> *A, const RowPlan &plan);

/// Rank 0: the whole, in the order of q, of the rows that each rank has; empty on others.  Collective.
Eigen::SparseMatrix<double> collected(const fem::Ranks &ranks, const fem::CompressedRows &own, const RowPlan &plan);

/// The rows of a rank in a PETSc matrix, and the rows of A + B.
fem::CompressedRows own_rows(Mat A);
fem::CompressedRows sum(const fem::CompressedRows &A, const fem::CompressedRows &B);

/// The symmetric matrix [n x n] whose rows the ranks have; collective.
PetscOwned<Mat> shared_matrix(const fem::CompressedRows &rows, int n);

} // namespace gestell::coupling
