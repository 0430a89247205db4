#pragma once

#include "coupling/eigensolvers/block_lanczos.h"

#include <Eigen/SparseCore>

#include <memory>

namespace gestell::coupling
{

/**
 * The buckling factor: the smallest positive lambda of
 *
 *     (C + lambda K) x = 0,
 *
 * found by Krylov-Schur of SLEPc in the inner product of C as kappa = -1 / lambda, the lowest eigenvalue of
 * K x = kappa C x. Infinite if -kappa is less than 1e-4 of the largest eigenvalue: tension dominates.
 *
 * @param C  [n x n] stiffness, positive definite; K [n x n] geometric stiffness; both triangles stored.
 * @throws ConvergenceFailure.
 */
double buckling_factor(std::shared_ptr<const InverseStiffness> inverse, const Eigen::SparseMatrix<double> &C,
                       const Eigen::SparseMatrix<double> &K);

} // namespace gestell::coupling
