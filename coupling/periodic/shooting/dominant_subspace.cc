#include "coupling/periodic/shooting/dominant_subspace.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/periodic_solution.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// e^(Lambda T) of a block.
Block2 carried(const ModalBlock &block, double period)
{
  Block2 phi[1];
  phi_functions(block, period, 0, phi);
  return phi[0];
}

double kept(const ModalBlock &block, double period)
{
  const Block2 E = carried(block, period);
  return std::sqrt(E.a11 * E.a11 + E.a12 * E.a12 + E.a21 * E.a21 + E.a22 * E.a22) / M_SQRT2;
}
} // namespace

DominantSubspace::DominantSubspace(const PeriodicProblem &problem)
    : problem_(problem), omega_(2. * M_PI / problem.period), modes_(modal_blocks(*problem.system))
{
}

void DominantSubspace::choose(double share, double period)
{
  share_ = share;
  // The slowest motion has tangents in any case: where all die away, its multiplier is the largest.
  double slowest = 0.;
  for (Index b = 0; b < modes_.n_modal; ++b)
    slowest = std::max(slowest, kept(modes_.blocks[std::size_t(b)], period));
  slow_.clear();
  fast_.clear();
  phi_.setZero(2 * modes_.n_modal, 2 * modes_.n_modal);
  for (Index b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block = modes_.blocks[std::size_t(b)];
    const bool        fast  = kept(block, period) < std::min(share, slowest);
    for (const Index i : {2 * b, 2 * b + 1})
      (fast ? fast_ : slow_).push_back(i);
    const Block2 E = carried(block, period);
    if (fast)
      phi_.block<2, 2>(2 * b, 2 * b) << E.a11, E.a12, E.a21, E.a22;
  }
}

MatrixXd DominantSubspace::from_modes(const MatrixXd &x) const
{
  const Index n = modes_.Q.rows();
  MatrixXd    z(2 * n, x.cols());
  z.topRows(n)    = omega_ * (modes_.Q.leftCols(x.rows()) * x);
  z.bottomRows(n) = modes_.V.leftCols(x.rows()) * x;
  return z;
}

MatrixXd DominantSubspace::to_modes(const MatrixXd &z) const
{
  const Index n = modes_.Q.rows();
  return modes_.from_q * (z.topRows(n) / omega_) + modes_.from_v * z.middleRows(n, n);
}

void DominantSubspace::take(const MatrixXd &images, const VectorXd &rate)
{
  const Index n           = modes_.Q.rows();
  phi_(Eigen::all, slow_) = modes_.from_q * images.topRows(n) + modes_.from_v * images.bottomRows(n);
  newton_                 = phi_ - MatrixXd::Identity(2 * n, 2 * n);
  if (!problem_.period_is_unknown())
    return;
  newton_.conservativeResizeLike(MatrixXd::Zero(2 * n + 1, 2 * n + 1));
  newton_.col(2 * n).head(2 * n) = modes_.from_q * rate.head(n) + modes_.from_v * rate.tail(n);
  newton_.row(2 * n).head(2 * n) = omega_ * modes_.Q.row(problem_.phase).head(2 * n);
}

VectorXd DominantSubspace::correction(const VectorXd &residual) const
{
  const Index n = modes_.Q.rows();
  VectorXd    r(newton_.rows());
  r.head(2 * n) = to_modes(residual);
  if (problem_.period_is_unknown())
    r[2 * n] = residual[2 * n];
  const VectorXd dx = lu_solution(newton_, r);
  VectorXd       dz(r.size());
  dz.head(2 * n) = from_modes(dx.head(2 * n));
  if (problem_.period_is_unknown())
    dz[2 * n] = dx[2 * n];
  return dz;
}

/// An eigenvector y of Phi_ss belongs to (y, (mu - e^(Lambda_f T))^-1 Phi_fs y) of Phi_x.
MatrixXd DominantSubspace::dominant() const
{
  const GeneralEigenSolver eigen(phi_(slow_, slow_));
  const MatrixXd           phi_fs = phi_(fast_, slow_), phi_ff = phi_(fast_, fast_);
  const double             large_ones = std::min(share_, eigen.eigenvalues().cwiseAbs().maxCoeff());
  MatrixXd                 z(2 * modes_.Q.rows(), 0);
  for (Index k = 0; k < eigen.eigenvalues().size(); ++k)
  {
    const std::complex<double> mu = eigen.eigenvalues()[k];
    if (std::abs(mu) < large_ones || mu.imag() < 0.)
      continue;
    const Eigen::VectorXcd y = eigen.eigenvectors().col(k);
    Eigen::VectorXcd       x(phi_.rows());
    x(slow_)                 = y;
    Eigen::MatrixXcd shifted = -phi_ff.cast<std::complex<double>>();
    shifted.diagonal().array() += mu;
    const Eigen::VectorXcd input = phi_fs * y, follows = shifted.partialPivLu().solve(input);
    x(fast_)          = follows;
    const Index first = z.cols();
    z.conservativeResize(Eigen::NoChange, first + (mu.imag() > 0. ? 2 : 1));
    z.col(first) = from_modes(x.real());
    if (mu.imag() > 0.)
      z.col(first + 1) = from_modes(x.imag());
  }
  return orthonormal_columns(z, z.cols());
}

bool mostly_fast(DominantSubspace &motions, const PeriodicProblem &problem)
{
  // of itself that a fast motion keeps over a period: Newton's error falls by as much without it
  constexpr double first_share = 0.1;
  motions.choose(first_share, problem.period);
  // coordinates from which on the choice pays: directions cost a step's solution each
  constexpr int large = 20;
  return problem.turn.size() >= large && motions.size() < problem.turn.size();
}

void LargestMultipliers::take(MatrixXd images)
{
  images.topRows(images.rows() / 2) *= omega_;
  const MatrixXd           H = Z_.transpose() * images, outside = images - Z_ * H;
  const GeneralEigenSolver eigen(H);
  values_ = eigen.eigenvalues();
  residuals_.resize(values_.size());
  for (Index k = 0; k < values_.size(); ++k)
    residuals_[k] = (outside * eigen.eigenvectors().col(k)).norm() / eigen.eigenvectors().col(k).norm();
  double largest = 0.; // but for that of the shift in time
  // distance from 1 of its multiplier: known to closing errors times its condition
  constexpr double shift_in_time = 1e-6;
  for (const auto &mu : values_)
    if (std::abs(mu - 1.) > shift_in_time)
      largest = std::max(largest, std::abs(mu));
  leaves_                  = 0.;
  constexpr double decides = 0.7; // of the largest one, from which on multipliers count as large
  for (Index k = 0; k < values_.size(); ++k)
    if (std::abs(values_[k]) >= decides * largest)
      leaves_ = std::max(leaves_, residuals_[k]);
  constexpr double ritz_residual = 1e-8; // to which the largest multipliers are known: as finely as motions close
  converged_                     = leaves_ <= ritz_residual;
  Z_                             = orthonormal_columns(images, Z_.cols());
}

Eigen::VectorXcd LargestMultipliers::values() const
{
  std::vector<std::complex<double>> kept;
  constexpr double                  ritz_told = 1e-6; // to which those are that are told
  for (Index k = 0; k < values_.size(); ++k)
    if (residuals_[k] <= std::max(ritz_told, leaves_))
      kept.push_back(values_[k]);
  return largest_first(Eigen::Map<const Eigen::VectorXcd>(kept.data(), Index(kept.size())));
}

} // namespace gestell::coupling
