#pragma once

#include "fem/parallel/ranks.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

// Parts of a symmetric matrix for a rank, A(order, order); its first n_own rows belong to the rank, the rest to all.

/// Entries read by the elimination of the first n_columns columns, and the diagonal, with which the growth of rounding
/// is measured.
Eigen::SparseMatrix<double> lower_part(const Eigen::SparseMatrix<double> &C, const std::vector<int> &order,
                                       int n_columns);

/// Part of a sum over ranks; entries between common rows belong to the rank with with_border.
Eigen::SparseMatrix<double> additive_part(const Eigen::SparseMatrix<double> &M, const std::vector<int> &order,
                                          int n_own, bool with_border);

/// From rank 0 to another.
void                        send(const fem::Ranks &ranks, const Eigen::SparseMatrix<double> &A, int to);
Eigen::SparseMatrix<double> receive_matrix(const fem::Ranks &ranks);

} // namespace gestell::coupling
