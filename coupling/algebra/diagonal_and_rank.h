#pragma once

#include <Eigen/Core>

#include <optional>

namespace gestell::coupling
{

/// A = diag(diagonal) + G diag(signs) G^T
struct DiagonalAndRank
{
  Eigen::VectorXd diagonal; // [n]
  Eigen::MatrixXd G;        // [n x k]
  Eigen::VectorXd signs;    // [k] 1 or -1
};

/**
 * A symmetric matrix as a diagonal and a matrix of low rank, from its entries beside the diagonal alone.  With the even
 * rows P, the odd ones Q and P = (P1, P2),
 *
 *     A_PQ = U N,     S = U_1^+ A_P1P2 U_2^+T = X diag(signs) X^T,     G_P = U X,     G_Q^T = diag(signs) X^-1 N.
 *
 * @param tolerance  of the entries of A
 * @returns nothing if the rank is above `most` or n / 4, or an entry differs by more than the tolerance
 */
std::optional<DiagonalAndRank> diagonal_and_rank(const Eigen::MatrixXd &A, double tolerance, Eigen::Index most);

} // namespace gestell::coupling
