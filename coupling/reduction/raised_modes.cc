#include "coupling/reduction/raised_modes.h"

#include "coupling/reduction/basis.h"
#include "coupling/sparse_cholesky.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// Of the lowest omega^2, added where rigid motions are free: far from it, and far above rounding.
constexpr double shift_share = 0.1;

/// What elements of degree three leave of the error of quadratic ones lies between nothing, in smooth fields, and
/// (2 / 3)^2, at an edge with a singularity of the root: told is the middle in logarithms of what follows.
constexpr double left_over = 1.25;

/// Of C3 + s M3.
SparseCholesky factor(const fem::RaisedFrame &frame, double s, double available)
{
  if (s == 0.)
    return SparseCholesky(frame.C, {}, available);
  Eigen::SparseMatrix<double> A = frame.C + s * frame.M;
  A.makeCompressed();
  return SparseCholesky(A, {}, available);
}

} // namespace

Eigen::VectorXd raised_frequencies(const fem::RaisedFrame &frame, const Eigen::MatrixXd &X,
                                   const Eigen::VectorXd &omega, bool floats, double available)
{
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(frame.C.rows(), X.cols());
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    Y.row(frame.place[i]) = X.row(i);
  const Eigen::MatrixXd F = symmetric_product(frame.M, Y);

  const double s = floats ? shift_share * omega[0] * omega[0] : 0.;
  Y              = F;
  factor(frame, s, available).solve_in_place(Y);

  const Eigen::MatrixXd M = Y.transpose() * symmetric_product(frame.M, Y), C = Y.transpose() * F - s * M; // A Y = F
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(
      0.5 * (C + C.transpose()), 0.5 * (M + M.transpose()), Eigen::EigenvaluesOnly);
  return ritz.eigenvalues().cwiseMax(0.).cwiseSqrt();
}

double error_by_raising(double omega, double raised)
{
  return left_over * std::max(0., omega / raised - 1.);
}

} // namespace gestell::coupling
