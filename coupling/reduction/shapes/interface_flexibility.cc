#include "coupling/reduction/shapes/interface_flexibility.h"

#include "coupling/integration/system/dense_solvers.h"
#include "fem/assembly/rigid_body_modes.h"

#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd to_unit_diagonal(const MatrixXd &S)
{
  return S.diagonal().unaryExpr([](double s) { return s > 0. ? 1. / std::sqrt(s) : 1.; });
}

constexpr double suspicious = 1e-6; // eigenvalue of S scaled to unit diagonal: above it no motion is free

} // namespace

bool may_move_freely(const MatrixXd &S)
{
  if (S.rows() == 0)
    return false;
  const VectorXd d = to_unit_diagonal(S);
  return !(SymmetricEigenSolver(d.asDiagonal() * S * d.asDiagonal(), WithVectors::no).eigenvalues()(0) > suspicious);
}

MatrixXd motions_without_stiffness(const MatrixXd &S, const ReductionBasis &basis, const fem::FrameMatrices &frame)
{
  if (S.rows() == 0)
    return MatrixXd(basis.T.rows(), 0);
  const VectorXd             d = to_unit_diagonal(S);
  const SymmetricEigenSolver scaled(d.asDiagonal() * S * d.asDiagonal());
  if (scaled.eigenvalues()(0) > suspicious)
    return MatrixXd(basis.T.rows(), 0);
  if (frame.rigid_motions.cols() == 6)
    return fem::free_displacements(frame);
  constexpr double singular = 1e-11; // eigenvalues of S scaled to unit diagonal, of motions without stiffness
  const auto       count    = (scaled.eigenvalues().array() <= singular).count();
  return basis.constraint_modes() * (d.asDiagonal() * scaled.eigenvectors().leftCols(count));
}

MatrixXd inverse_beside(const MatrixXd &S, const MatrixXd &Z)
{
  if (S.rows() == 0)
    return S;
  const VectorXd d = to_unit_diagonal(S);
  MatrixXd       Q(S.rows(), Z.cols());
  if (Z.cols() > 0)
    Q = orthonormal_columns(d.cwiseInverse().asDiagonal() * Z, Z.cols());
  const MatrixXd             P = MatrixXd::Identity(S.rows(), S.rows()) - Q * Q.transpose();
  const SymmetricEigenSolver nearby(P * (d.asDiagonal() * S * d.asDiagonal()) * P + Q * Q.transpose());
  const VectorXd inverse = nearby.eigenvalues().unaryExpr([](double lambda) { return lambda > 0. ? 1. / lambda : 0.; });
  const MatrixXd U       = d.asDiagonal() * P * nearby.eigenvectors();
  return U * inverse.asDiagonal() * U.transpose();
}

} // namespace gestell::coupling
