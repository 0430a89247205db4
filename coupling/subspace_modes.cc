#include "coupling/subspace_modes.h"

#include "coupling/integration/second_order_system.h"
#include "coupling/sparse_cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int max_iterations = 100;

double shift(const SparseMatrix &C, const SparseMatrix &M)
{
  const VectorXd c = C.diagonal(), m = M.diagonal();
  double         lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < c.size(); ++i)
    if (c(i) > 0. && m(i) > 0.)
      lowest = std::min(lowest, c(i) / m(i));
  return std::isfinite(lowest) ? 0.01 * lowest : 1.;
}

SparseCholesky factor_of(const SparseMatrix &A)
{
  try
    {
      return SparseCholesky(A);
    }
  catch (const NotPositiveDefinite &failure)
    {
      throw std::invalid_argument("subspace_modes: a motion of coordinate " + std::to_string(failure.row) +
                                  " has neither stiffness nor mass; give it one of them or leave the coordinate out");
    }
}

MatrixXd irregular(Eigen::Index n, Eigen::Index k)
{
  MatrixXd X(n, k);
  for (Eigen::Index j = 0; j < k; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      X(i, j) = std::fmod(0.6180339887498949 * double(i + 1) * double((j + 1) * (j + 1)), 1.) - 0.5;
  return X;
}

} // namespace

DenseModes subspace_modes(const SparseMatrix &C, const SparseMatrix &M, int count, double tolerance)
{
  const auto n = C.rows(), k = std::min<Eigen::Index>(n, std::max(2 * count, count + 8));
  if (count == 0)
    return {VectorXd(0), MatrixXd(n, 0)};
  const SparseMatrix   A = C + shift(C, M) * M;
  const SparseCholesky factor = factor_of(A);

  MatrixXd X = irregular(n, k);
  VectorXd previous;
  for (int iteration = 0; iteration < max_iterations; ++iteration)
    {
      MatrixXd       Y  = M * X;
      const MatrixXd F  = Y;
      factor.solve_in_place(Y);
      const MatrixXd YMY = Y.transpose() * (M * Y), YCY = Y.transpose() * (C * Y);
      DenseModes     ritz = dense_modes(0.5 * (YCY + YCY.transpose()), 0.5 * (YMY + YMY.transpose()));
      X                   = Y * ritz.V;
      const auto     found   = std::min<Eigen::Index>(count, ritz.omega.size());
      const VectorXd omega   = ritz.omega.head(found);
      const bool     settled = previous.size() == found &&
                           ((omega - previous).cwiseAbs().array() <= tolerance * omega.array()).all();
      if (settled || k == n)
        return {omega, X.leftCols(found)};
      previous = omega;
    }
  throw ConvergenceFailure("subspace_modes: the " + std::to_string(count) + " lowest frequencies still change after " +
                           std::to_string(max_iterations) + " iterations; ask for more or fewer modes");
}

} // namespace gestell::coupling
