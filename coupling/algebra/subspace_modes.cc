#include "coupling/algebra/subspace_modes.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/integration/system/second_order_system.h"

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

constexpr int    max_iterations = 100;
constexpr double cancelled      = 1e-13; // share of v^T C v left of its terms, below which v is a rigid motion
constexpr double regular_pivots = 1e-12;
constexpr double first_share    = 1e-4; // of the lowest C_ii / M_ii: the first shift of a floating structure
constexpr double wanted_share   = 0.3;  // of the lowest elastic omega^2: the shift that converges well

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

/// C + s M and its factor.
struct Shifted
{
  double         s;
  SparseCholesky factor;
};

/// s = 0 if C is regular by its pivots.
Shifted first_shift(const SparseMatrix &C, const SparseMatrix &M)
{
  try
  {
    SparseCholesky factor(C);
    if (factor.pivot_ratio() > regular_pivots)
      return {0., std::move(factor)};
  }
  catch (const NotPositiveDefinite &)
  {
  }
  const double s = first_share * lowest_quotient(C, M);
  try
  {
    return {s, SparseCholesky(C + s * M)};
  }
  catch (const NotPositiveDefinite &failure)
  {
    throw std::invalid_argument("subspace_modes: a motion of coordinate " + std::to_string(failure.row) +
                                " has neither stiffness nor mass; give it one of them or leave the coordinate out");
  }
}

/// Rayleigh quotients of M-normal columns; 0 for rigid motions, of which v^T C v is what rounding left.
VectorXd frequencies(const Eigen::Ref<const MatrixXd> &V, const SparseMatrix &C, const SparseMatrix &magnitude)
{
  VectorXd omega(V.cols());
  for (Eigen::Index j = 0; j < V.cols(); ++j)
  {
    const VectorXd v = V.col(j), size = v.cwiseAbs();
    const double   square = v.dot(C * v);
    omega(j)              = square > cancelled * size.dot(magnitude * size) ? std::sqrt(square) : 0.;
  }
  return omega;
}

/// The lowest omega^2 above the rigid motions, 0 if there is none.
double lowest_elastic_square(const VectorXd &omega)
{
  for (Eigen::Index j = 0; j < omega.size(); ++j)
    if (omega(j) > 0.)
      return omega(j) * omega(j);
  return 0.;
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
    return {VectorXd(0), MatrixXd(n, 0), {}};
  Shifted            shifted   = first_shift(C, M);
  MatrixXd           X         = irregular(n, k);
  const SparseMatrix magnitude = C.cwiseAbs();
  VectorXd           previous;
  for (int iteration = 0; iteration < max_iterations; ++iteration)
  {
    MatrixXd Y = M * X;
    shifted.factor.solve_in_place(Y);
    const MatrixXd   YMY = Y.transpose() * (M * Y), YCY = Y.transpose() * (C * Y);
    const DenseModes ritz  = dense_modes(0.5 * (YCY + YCY.transpose()), 0.5 * (YMY + YMY.transpose()));
    X                      = Y * ritz.V;
    const auto     found   = std::min<Eigen::Index>(count, ritz.omega.size());
    const VectorXd omega   = frequencies(X.leftCols(found), C, magnitude);
    const bool     settled = iteration > 2 && previous.size() == found &&
                         ((omega - previous).cwiseAbs().array() <= tolerance * omega.array()).all();
    if (settled || k == n)
      return {omega, X.leftCols(found), {}};
    previous            = omega;
    const double wanted = wanted_share * lowest_elastic_square(omega);
    if (wanted > 0. && shifted.s > 10. * wanted)
      shifted = {wanted, SparseCholesky(C + wanted * M)};
  }
  throw ConvergenceFailure("subspace_modes: the " + std::to_string(count) + " lowest frequencies still change after " +
                           std::to_string(max_iterations) + " iterations; ask for more or fewer modes");
}

} // namespace gestell::coupling
