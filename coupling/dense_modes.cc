#include "coupling/dense_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double massless    = 1e-13; // mu relative to the largest, below which a mode has no mass
constexpr int    most_shifts = 20;    // times ten each
constexpr double certain     = 1e3;   ///< times what rounding leaves: a rigid motion is not said to grow
constexpr double at_rest     = 1e-20; // omega^2 beside the lowest quotient C_ii / M_ii: what rounding of v leaves there
constexpr double rigid = 1e-11; // smallest eigenvalue of C scaled to unit diagonal, below which C counts as singular

/// 1 / sqrt of the diagonal, 1 where it is zero: makes metres and radians comparable.
VectorXd unit_diagonal(const MatrixXd &A)
{
  return A.diagonal().unaryExpr([](double a) { return a > 0. ? 1. / std::sqrt(a) : 1.; });
}

/// Smallest C_ii / M_ii that is more than rounding beside the largest; an upper bound of the lowest omega^2 that is not
/// 0. `floating` tells whether smaller ones were left out.
double lowest_quotient(const MatrixXd &C, const MatrixXd &M, double cancelled, bool &floating)
{
  VectorXd quotients(C.rows());
  int      n = 0;
  for (int i = 0; i < C.rows(); ++i)
    if (M(i, i) > 0.)
      quotients(n++) = C(i, i) / M(i, i);
  const double largest = n > 0 ? quotients.head(n).maxCoeff() : 0.;
  double       s       = largest;
  for (int i = 0; i < n; ++i)
    if (quotients(i) > cancelled * largest)
      s = std::min(s, quotients(i));
    else
      floating = true;
  return s > 0. ? s : 1.;
}

enum class Stiffness
{
  regular,  ///< every motion is held
  singular, ///< some are free
  unstable  ///< some are driven away: a linkage about to fall
};

Stiffness stiffness_of(const MatrixXd &C)
{
  const VectorXd                                d = unit_diagonal(C);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(d.asDiagonal() * C * d.asDiagonal(), Eigen::EigenvaluesOnly);
  const VectorXd                               &values = scaled.eigenvalues();
  return values.minCoeff() > rigid                                   ? Stiffness::regular
         : values.minCoeff() < -rigid * values.cwiseAbs().maxCoeff() ? Stiffness::unstable
                                                                     : Stiffness::singular;
}

void require_motion(const MatrixXd &A, const Eigen::LLT<MatrixXd> &factor)
{
  if (factor.info() == Eigen::Success)
    return;
  int                                           weakest;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(A);
  modes.eigenvectors().col(0).cwiseAbs().maxCoeff(&weakest);
  throw std::invalid_argument("dense_modes: a motion of coordinate " + std::to_string(weakest) +
                              " has neither stiffness nor mass; give it one of them or leave the coordinate out");
}

} // namespace

DenseModes dense_modes(const MatrixXd &C, const MatrixXd &M, double cancelled)
{
  if (C.rows() == 0)
    return {};
  bool            floating  = false;
  const double    lowest    = lowest_quotient(C, M, cancelled, floating);
  const Stiffness stiffness = stiffness_of(C);
  double          s         = !floating && stiffness == Stiffness::regular ? 0. : lowest;
  VectorXd        d;
  MatrixXd        scaled;

  Eigen::LLT<MatrixXd> L;
  const auto           factorise = [&]
  {
    const MatrixXd A = C + s * M;
    d                = unit_diagonal(A);
    scaled           = d.asDiagonal() * A * d.asDiagonal();
    L.compute(scaled);
  };
  factorise();
  // The shift must outweigh the fastest fall, of rate sqrt(-omega^2).
  for (int i = 0; i < most_shifts && stiffness == Stiffness::unstable && L.info() != Eigen::Success; ++i)
  {
    s *= 10.;
    factorise();
  }
  require_motion(scaled, L);
  MatrixXd H = d.asDiagonal() * M * d.asDiagonal(); // H = L^-1 D M D L^-T
  L.matrixL().solveInPlace(H);
  H = H.transpose().eval();
  L.matrixL().solveInPlace(H);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(H);

  const VectorXd &mu = solver.eigenvalues(); // ascending: omega descending
  const int       n  = int(mu.size());
  int             p  = 0;
  while (p < n && mu(n - 1 - p) > massless * mu(n - 1))
    ++p;
  DenseModes modes{VectorXd(p), solver.eigenvectors().rightCols(p).rowwise().reverse(), VectorXd::Zero(p)};
  L.matrixU().solveInPlace(modes.V);
  modes.V = d.asDiagonal() * modes.V;
  for (int j = 0; j < p; ++j)
  {
    auto v = modes.V.col(j);
    v /= std::sqrt(v.dot(M * v));
    const double square   = v.dot(C * v);
    const double rounding = std::max(cancelled * v.cwiseAbs().dot(C.cwiseAbs() * v.cwiseAbs()), at_rest * lowest);
    modes.omega(j)        = square > rounding ? std::sqrt(square) : 0.;
    if (-square > certain * rounding)
      modes.growth(j) = std::sqrt(-square);
  }
  return modes;
}

} // namespace gestell::coupling
