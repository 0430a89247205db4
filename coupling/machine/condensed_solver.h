#pragma once

#include "coupling/integration/system/linear_system.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// The modal coordinates L of a base system: n of them, consecutive.
struct ModalRange
{
  int first = 0, n = 0;
};

/// The matrices of a step by blocks.  A_LN, M_LN: their first columns, up to the last one in either that is not zero
/// [n_L x k]; A_LL: its diagonal.
struct CondensedMatrices
{
  Eigen::MatrixXd A_NN, A_LN;
  Eigen::VectorXd A_LL;
  Eigen::MatrixXd M_NN, M_LN;
};

/// (5.5.3/4-7) for a diagonal A_LL:  G = A_LL^-1 A_LN,  q_N = A_red^-1 (f_N - G^T f_L),  q_L = A_LL^-1 f_L - G q_N.
/// @throws std::invalid_argument if A is singular
std::unique_ptr<LinearSolver> condensed_solver(const CondensedMatrices &matrices, const ModalRange &L,
                                               const std::vector<int> &N);

/**
 * A^-1 of a symmetric matrix: scaled to unit diagonal, inverted by Cholesky (or by LU if A is indefinite), and improved
 * by one step of Newton's iteration X <- X (2 E - A X), which squares the rounding error.
 * @param names  of the coordinates of the rows of A, for messages.
 * @throws std::invalid_argument if A is singular
 */
Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd &A, const std::vector<int> &names);

[[noreturn]] void refuse_singular(int coordinate);

/// to = entries of x at the positions `which`.
inline void gather(const Eigen::VectorXd &x, const std::vector<int> &which, Eigen::VectorXd &to)
{
  for (std::size_t i = 0; i < which.size(); ++i)
    to[Eigen::Index(i)] = x[which[i]];
}

inline void scatter(const Eigen::VectorXd &from, const std::vector<int> &which, Eigen::VectorXd &x)
{
  for (std::size_t i = 0; i < which.size(); ++i)
    x[which[i]] = from[Eigen::Index(i)];
}

} // namespace gestell::coupling
