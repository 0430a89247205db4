#pragma once

#include "coupling/algebra/dense_modes.h"

#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * The lowest modes of (C - omega^2 M) v = 0 of large sparse matrices by BlockLanczos, rigid-body modes with omega = 0.
 *
 * If C is singular, C + s M is used instead, with s far below the lowest C_ii / M_ii; frequencies are the Rayleigh
 * quotients of the modes.
 *
 * @param C,     M   symmetric [n x n], both triangles stored; C positive semidefinite, C + s M positive definite.
 * @param count  0 <= count <= n; fewer are returned if M has a lower rank.
 * @throws std::invalid_argument if C + s M is not positive definite; ConvergenceFailure.
 */
DenseModes sparse_modes(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M, int count);

} // namespace gestell::coupling
