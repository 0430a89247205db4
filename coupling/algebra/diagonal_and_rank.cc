#include "coupling/algebra/diagonal_and_rank.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Every second row from `first` on.
MatrixXd half(const MatrixXd &A, Index first)
{
  return A(Eigen::seq(first, Eigen::last, 2), Eigen::all);
}

/// X with A X ~ Y, least squares.
MatrixXd solution(const MatrixXd &A, const MatrixXd &Y)
{
  return Eigen::ColPivHouseholderQR<MatrixXd>(A).solve(Y);
}

/// The part of low rank, tentatively; without columns if it has more than `most`.
DiagonalAndRank guess(const MatrixXd &A, double negligible, Index most)
{
  const Index     n = A.rows();
  const auto      P = Eigen::seq(0, Eigen::last, 2), Q = Eigen::seq(1, Eigen::last, 2);
  const MatrixXd  A_P = A(P, P), A_PQ = A(P, Q);
  DiagonalAndRank parts{VectorXd(n), MatrixXd(n, 0), VectorXd(0)};

  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A_PQ);
  const VectorXd                             pivots = qr.matrixQR().diagonal().cwiseAbs();
  const Index                                k      = (pivots.array() > negligible).count();
  if (k == 0 || k > most)
    return parts;
  const MatrixXd U = qr.householderQ() * MatrixXd::Identity(A_PQ.rows(), k), N = U.transpose() * A_PQ;
  const MatrixXd A_12 = half(half(A_P, 0).transpose(), 1).transpose();
  const MatrixXd S    = solution(half(U, 1), solution(half(U, 0), A_12).transpose());

  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(0.5 * (S + S.transpose()));
  const VectorXd                                root = solver.eigenvalues().cwiseAbs().cwiseSqrt();
  if (!(root.minCoeff() > 0.))
    return parts;
  parts.signs            = solver.eigenvalues().cwiseSign();
  const MatrixXd E       = solver.eigenvectors();
  parts.G                = MatrixXd(n, k);
  parts.G(P, Eigen::all) = U * E * root.asDiagonal();
  parts.G(Q, Eigen::all) = N.transpose() * E * (root.cwiseInverse().cwiseProduct(parts.signs)).asDiagonal();
  return parts;
}

} // namespace

std::optional<DiagonalAndRank> diagonal_and_rank(const MatrixXd &A, double tolerance, Index most)
{
  constexpr double below = 0.1; // of the tolerance: omitted pivots add up
  DiagonalAndRank  parts = guess(A, below * tolerance, std::min(most, A.rows() / 4));
  MatrixXd         rest  = A - parts.G * parts.signs.asDiagonal() * parts.G.transpose();
  parts.diagonal         = rest.diagonal();
  rest.diagonal().setZero();
  if (!(rest.cwiseAbs().maxCoeff() <= tolerance))
    return {};
  return parts;
}

} // namespace gestell::coupling
