#include "coupling/reduction/estimates/refined_modes.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/shapes/interface_flexibility.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Elastic modes, in the complement of the rigid motions (rigid; 0), rigid [n1 x k].
DenseModes elastic_modes(const MatrixXd &C, const MatrixXd &M, const MatrixXd &rigid)
{
  const auto n = C.rows(), k = rigid.cols();
  if (k == 0)
    return dense_modes(C, M, cancelled_by_reduction, 0);
  const MatrixXd inertia = M.leftCols(rigid.rows()) * rigid;
  const MatrixXd Z       = orthonormal_columns(inertia, n).rightCols(n - k);
  DenseModes     modes   = dense_modes(Z.transpose() * C * Z, Z.transpose() * M * Z, cancelled_by_reduction, 0);
  modes.V                = Z * modes.V;
  return modes;
}

} // namespace

RefinedModes refined_modes(const ReductionBasis &basis, const ReducedMatrices &star,
                           const ResidualFlexibility &response, const fem::FrameMatrices &frame)
{
  const int      n1 = basis.n1(), m = basis.m();
  const MatrixXd S = star.C.topLeftCorner(n1, n1);
  RefinedModes   modes;
  modes.rigid          = motions_without_stiffness(S, basis, frame)(basis.q1, Eigen::all);
  modes.n_rigid        = int(modes.rigid.cols());
  const MatrixXd Phi_e = elastic_modes(star.C, star.M, modes.rigid).V;

  // [T, X]^T M [T, X]
  MatrixXd gram(n1 + m + n1, n1 + m + n1);
  gram.topLeftCorner(n1 + m, n1 + m) = star.M;
  gram.topRightCorner(n1, n1)        = response.Psi_M_X;
  gram.block(n1, n1 + m, m, n1) = basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() * star.M.bottomLeftCorner(m, n1);
  gram.bottomLeftCorner(n1, n1 + m) = gram.topRightCorner(n1 + m, n1).transpose();
  gram.bottomRightCorner(n1, n1)    = response.X_M_X;
  const auto TM                     = gram.topRows(n1 + m);

  // Y = C^-1 M T Phi = [T, X] y
  MatrixXd y(n1 + m + n1, Phi_e.cols());
  y.topRows(n1)       = inverse_beside(S, modes.rigid) * (star.M.topRows(n1) * Phi_e);
  y.middleRows(n1, m) = basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() * Phi_e.bottomRows(m);
  y.bottomRows(n1)    = Phi_e.topRows(n1);
  if (modes.n_rigid > 0)
  {
    const MatrixXd inertia = modes.rigid.transpose() * TM.topRows(n1);
    y.topRows(n1) -= modes.rigid * (inertia.leftCols(n1) * modes.rigid).ldlt().solve(inertia * y);
  }

  const MatrixXd P   = TM * y; // T^T M Y
  const MatrixXd YCY = P.transpose() * Phi_e;
  const MatrixXd YMY = y.transpose() * gram * y;
  modes.omega        = dense_modes(0.5 * (YCY + YCY.transpose()), 0.5 * (YMY + YMY.transpose())).omega;
  return modes;
}

RefinedModes ritz_modes(const ReducedMatrices &star, int n_rigid)
{
  const VectorXd omega = dense_modes(star.C, star.M, cancelled_by_reduction, n_rigid).omega;
  return {n_rigid, omega.tail(omega.size() - n_rigid)};
}

FrequencyEstimate frequency_estimate(const ReducedMatrices &star, int n1, int m, const RefinedModes &refined)
{
  const int         n = n1 + m;
  const MatrixXd    C = star.C.topLeftCorner(n, n), M = star.M.topLeftCorner(n, n);
  FrequencyEstimate estimate;
  if (refined.rigid.cols() == refined.n_rigid)
  {
    const VectorXd elastic              = elastic_modes(C, M, refined.rigid).omega;
    estimate.omega                      = VectorXd::Zero(refined.n_rigid + elastic.size());
    estimate.omega.tail(elastic.size()) = elastic;
  }
  else
    estimate.omega = dense_modes(C, M, cancelled_by_reduction, refined.n_rigid).omega;
  estimate.error = VectorXd::Constant(estimate.omega.size(), std::numeric_limits<double>::quiet_NaN());
  estimate.error.head(std::min<Eigen::Index>(refined.n_rigid, estimate.error.size())).setZero();
  for (int j = refined.n_rigid; j < estimate.omega.size() && j - refined.n_rigid < refined.omega.size(); ++j)
    estimate.error(j) = std::max(0., estimate.omega(j) / refined.omega(j - refined.n_rigid) - 1.);
  return estimate;
}

} // namespace gestell::coupling
