#pragma once

#include "coupling/algebra/dense_modes.h"

#include <Eigen/SparseCore>

namespace gestell::coupling
{

/**
 * The lowest modes (C - omega^2 M) v = 0 of large sparse matrices by simultaneous inverse iteration with Rayleigh-Ritz
 * (Bathe's subspace iteration), for those who do without SLEPc.  Rigid motions come with omega = 0.
 *
 * Iterates on C, or if that is singular on C + s M with s lowered towards the lowest elastic omega^2, until the
 * frequencies change by less than `tolerance`.
 *
 * @param C, M   symmetric [n x n], both triangles stored; C positive semidefinite, C + s M positive definite.
 * @param count  0 <= count <= n; fewer come back if M has a lower rank.
 * @throws std::invalid_argument if C + s M is not positive definite; ConvergenceFailure after 100 iterations.
 */
DenseModes subspace_modes(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M, int count,
                          double tolerance = 1e-9);

} // namespace gestell::coupling
