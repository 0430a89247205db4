#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>

namespace gestell::coupling
{

/// x <- C^-1 f for n numbers; f and x are different places.
using InverseStiffness = std::function<void(const double *f, double *x)>;

struct LowestModes
{
  Eigen::VectorXd omega; // [m] ascending, rad/s
  Eigen::MatrixXd V;     // [n x m], V^T M V = E
};

/**
 * The lowest modes of (C - omega^2 M) v = 0: Krylov-Schur of SLEPc in the inner product of M, spectral transform at
 * shift 0 with the solver given, so that its factor serves other purposes too.
 *
 * A solver that holds some coordinates (returns zero for them) gives the modes of the held structure.
 *
 * @param C, M     [n x n] symmetric, both triangles stored.
 * @param count    number of modes wanted, 0 <= count <= n.
 * @param known    [n x k] modes found before, M-orthonormal: only higher ones are looked for.
 * @throws ConvergenceFailure with the number found.
 */
LowestModes lowest_modes(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M,
                         const InverseStiffness &inverse, int count, const Eigen::Ref<const Eigen::MatrixXd> &known);

} // namespace gestell::coupling
