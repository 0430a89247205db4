#include "coupling/eigensolvers/sparse_modes.h"

#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/integration/system/convergence_failure.h"

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

/// The lowest C_ii / M_ii, an upper bound of the lowest omega^2.
double lowest_quotient(const SparseMatrix &C, const SparseMatrix &M)
{
  const VectorXd c = C.diagonal(), m = M.diagonal();
  double         lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < c.size(); ++i)
    if (c(i) > 0. && m(i) > 0.)
      lowest = std::min(lowest, c(i) / m(i));
  return std::isfinite(lowest) ? lowest : 1.;
}

/// Factor of C if C is regular according to its pivots; otherwise of C + s M.
SparseCholesky regular_factor(const SparseMatrix &C, const SparseMatrix &M)
{
  try
  {
    SparseCholesky   factor(C);
    constexpr double regular_pivots = 1e-12; // ratio of pivots: below it C is singular up to rounding
    if (factor.pivot_ratio() > regular_pivots)
      return factor;
  }
  catch (const NotPositiveDefinite &)
  {
  }
  // of the lowest C_ii / M_ii, a bound of the lowest omega^2: far below it, far above rounding
  constexpr double shift_share = 1e-4;
  const double     s           = shift_share * lowest_quotient(C, M);
  try
  {
    return SparseCholesky(C + s * M);
  }
  catch (const NotPositiveDefinite &failure)
  {
    throw std::invalid_argument("modes: DOF " + std::to_string(failure.row) +
                                " has neither stiffness nor mass; give it one of them or remove the DOF");
  }
}

/// Rayleigh quotients of M-normal columns; 0 for rigid motions, whose v^T C v is rounding.
VectorXd frequencies(const Eigen::Ref<const MatrixXd> &V, const SparseMatrix &C, const SparseMatrix &magnitude)
{
  VectorXd omega(V.cols());
  for (Eigen::Index j = 0; j < V.cols(); ++j)
  {
    const VectorXd v = V.col(j), size = v.cwiseAbs();
    const double   square = v.dot(C * v);
    // share of v^T C v left of its terms, below which v is a rigid motion: their rounding
    constexpr double cancelled = 1e-13;
    omega(j)                   = square > cancelled * size.dot(magnitude * size) ? std::sqrt(square) : 0.;
  }
  return omega;
}

} // namespace

DenseModes sparse_modes(const SparseMatrix &C, const SparseMatrix &M, int count)
{
  const SparseCholesky factor = regular_factor(C, M);
  BlockLanczos         search(M, std::make_unique<InverseByFactor>(factor), {});
  try
  {
    search.find(count);
  }
  catch (const ConvergenceFailure &)
  {
    if (!search.exhausted())
      throw;
  }
  const MatrixXd V = search.modes(std::min(count, search.n_found())).V;
  return {frequencies(V, C, C.cwiseAbs()), V, {}};
}

} // namespace gestell::coupling
