#include "coupling/reduction/supported_modes.h"

#include "coupling/dense_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double cancelled = 1e-10; // as `cancelled` of dense_modes(): C*_11 is the difference of far larger matrices
constexpr double singular  = 1e-11; // eigenvalue of S scaled to unit diagonal, below which a motion is rigid

/// S^-1, on the complement of the null space if S is singular.
MatrixXd pseudo_inverse(const MatrixXd &S)
{
  if (S.rows() == 0)
    return S;
  const VectorXd d = S.diagonal().unaryExpr([](double s) { return s > 0. ? 1. / std::sqrt(s) : 1.; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(d.asDiagonal() * S * d.asDiagonal());
  const VectorXd                                inverse =
      scaled.eigenvalues().unaryExpr([](double lambda) { return lambda > singular ? 1. / lambda : 0.; });
  const MatrixXd U = d.asDiagonal() * scaled.eigenvectors();
  return U * inverse.asDiagonal() * U.transpose();
}

} // namespace

SupportedModes supported_modes(const ReductionBasis &basis, const ReducedMatrices &star,
                               const InteriorResponse &response)
{
  const int        n1 = basis.n1(), m = basis.m();
  const DenseModes ritz = dense_modes(star.C, star.M, cancelled);

  SupportedModes modes;
  modes.n_rigid          = int((ritz.omega.array() == 0.).count());
  const auto     elastic = ritz.omega.size() - modes.n_rigid;
  const MatrixXd Phi_r = ritz.V.leftCols(modes.n_rigid), Phi_e = ritz.V.rightCols(elastic);

  // [T, X]^T M [T, X]
  MatrixXd gram(n1 + m + n1, n1 + m + n1);
  gram.topLeftCorner(n1 + m, n1 + m) = star.M;
  gram.topRightCorner(n1, n1)        = response.Psi_M_X;
  gram.block(n1, n1 + m, m, n1) = basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() * star.M.bottomLeftCorner(m, n1);
  gram.bottomLeftCorner(n1, n1 + m) = gram.topRightCorner(n1 + m, n1).transpose();
  gram.bottomRightCorner(n1, n1)    = response.X_M_X;
  const auto TM                     = gram.topRows(n1 + m);

  // Y = C^-1 M T Phi = [T, X] y
  MatrixXd y(n1 + m + n1, elastic);
  y.topRows(n1)       = pseudo_inverse(star.C.topLeftCorner(n1, n1)) * (star.M.topRows(n1) * Phi_e);
  y.middleRows(n1, m) = basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() * Phi_e.bottomRows(m);
  y.bottomRows(n1)    = Phi_e.topRows(n1);
  if (modes.n_rigid > 0)
    y.topRows(n1 + m) -= Phi_r * (Phi_r.transpose() * (TM * y));

  const MatrixXd   P       = TM * y; // T^T M Y
  const MatrixXd   YCY     = P.transpose() * Phi_e;
  const MatrixXd   YMY     = y.transpose() * gram * y;
  const DenseModes refined = dense_modes(0.5 * (YCY + YCY.transpose()), 0.5 * (YMY + YMY.transpose()));
  modes.omega              = refined.omega;
  modes.P                  = P * refined.V;
  return modes;
}

FrequencyEstimate frequency_estimate(const ReducedMatrices &star, int n1, int m, const SupportedModes &refined)
{
  const int         n = n1 + m;
  FrequencyEstimate estimate;
  estimate.omega = dense_modes(star.C.topLeftCorner(n, n), star.M.topLeftCorner(n, n), cancelled).omega;
  estimate.error = VectorXd::Constant(estimate.omega.size(), std::numeric_limits<double>::quiet_NaN());
  estimate.error.head(std::min<Eigen::Index>(refined.n_rigid, estimate.error.size())).setZero();
  for (int j = refined.n_rigid; j < estimate.omega.size() && j - refined.n_rigid < refined.omega.size(); ++j)
    estimate.error(j) = std::max(0., estimate.omega(j) / refined.omega(j - refined.n_rigid) - 1.);
  return estimate;
}

} // namespace gestell::coupling
