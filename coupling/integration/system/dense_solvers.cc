#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace gestell::coupling
{

using Eigen::MatrixXd;

SymmetricEigenSolver::SymmetricEigenSolver(const MatrixXd &A, WithVectors vectors)
{
  const bool                                    wanted = vectors == WithVectors::yes;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A, wanted ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly);
  values_ = solver.eigenvalues();
  if (wanted)
    vectors_ = solver.eigenvectors();
  converged_ = solver.info() == Eigen::Success;
}

SymmetricPencilSolver::SymmetricPencilSolver(const MatrixXd &A, const MatrixXd &B, WithVectors vectors)
{
  const bool                                               wanted = vectors == WithVectors::yes;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(
      A, B, (wanted ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly) | Eigen::Ax_lBx);
  values_ = solver.eigenvalues();
  if (wanted)
    vectors_ = solver.eigenvectors();
  converged_ = solver.info() == Eigen::Success;
}

GeneralEigenSolver::GeneralEigenSolver(const MatrixXd &A, WithVectors vectors)
{
  const bool                         wanted = vectors == WithVectors::yes;
  const Eigen::EigenSolver<MatrixXd> solver(A, wanted);
  converged_ = solver.info() == Eigen::Success;
  if (!converged_)
    return;
  values_ = solver.eigenvalues();
  if (wanted)
    vectors_ = solver.eigenvectors();
}

struct LeastSquaresSolver::Decomposition
{
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
};

LeastSquaresSolver::LeastSquaresSolver()                                          = default;
LeastSquaresSolver::~LeastSquaresSolver()                                         = default;
LeastSquaresSolver::LeastSquaresSolver(LeastSquaresSolver &&) noexcept            = default;
LeastSquaresSolver &LeastSquaresSolver::operator=(LeastSquaresSolver &&) noexcept = default;

LeastSquaresSolver::LeastSquaresSolver(const MatrixXd &A, double threshold)
    : decomposition_(std::make_unique<Decomposition>())
{
  if (threshold > 0.)
    decomposition_->qr.setThreshold(threshold);
  decomposition_->qr.compute(A);
}

MatrixXd LeastSquaresSolver::solution(const MatrixXd &B) const
{
  return decomposition_->qr.solve(B);
}

Eigen::Index LeastSquaresSolver::rank() const
{
  return decomposition_->qr.rank();
}

MatrixXd LeastSquaresSolver::null_space() const
{
  const auto        &qr = decomposition_->qr;
  const Eigen::Index n  = qr.cols();
  if (qr.rank() == n)
    return MatrixXd(n, 0);
  return qr.colsPermutation() * MatrixXd(qr.matrixZ().transpose()).rightCols(n - qr.rank());
}

MatrixXd lu_solution(const MatrixXd &A, const MatrixXd &B)
{
  return A.partialPivLu().solve(B);
}

MatrixXd orthonormal_columns(const MatrixXd &A, Eigen::Index k)
{
  return Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), k);
}

} // namespace gestell::coupling
