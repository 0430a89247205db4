#include "tests/support/lowest_modes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace gestell::test
{

Modes lowest_modes(const fem::FrameMatrices &frame, int n_modes)
{
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(frame.C);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("lowest_modes: the frame is not held");

  const int       size = 2 * n_modes + 8; // more vectors than modes make the last ones converge fast
  Eigen::MatrixXd X    = Eigen::MatrixXd::Random(frame.C.rows(), size);
  Eigen::VectorXd last = Eigen::VectorXd::Zero(n_modes);
  for (int iteration = 0; iteration < 200; ++iteration)
  {
    X = factor.solve(frame.M * X).eval();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(X.transpose() * (frame.C * X),
                                                                          X.transpose() * (frame.M * X));
    X                             = (X * small.eigenvectors()).eval();
    const Eigen::VectorXd squares = small.eigenvalues().head(n_modes);
    const double enough = iteration < 40 ? 2e-12 : 1e-9; // rounding in C of thin plates leaves more
    if ((squares - last).cwiseAbs().maxCoeff() < enough * squares.maxCoeff())
      return {squares.cwiseSqrt() / (2. * EIGEN_PI), X.leftCols(n_modes)};
    last = squares;
  }
  throw std::runtime_error("lowest_modes: no convergence");
}

} // namespace gestell::test
