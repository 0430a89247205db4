#include "coupling/periodic/passage_differences.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
} // namespace

/// Directions with their images.
class PassageDifferences::Space
{
public:
  Space(VectorXd z, End end, const VectorXd &sizes, const Passage &passage, const Map &nearest)
      : z_(std::move(z)), sizes_(sizes), passage_(passage), nearest_(nearest), end_(std::move(end)), place_(nearest(z_))
  {
    constexpr double least_size = 1e-4; // of the largest: below it differences would be rounding
    const double     largest    = sizes_.maxCoeff();
    sizes_                      = sizes_.cwiseMax(largest > 0. ? least_size * largest : 1.);
  }

  Index    size() const { return D_.cols(); }
  VectorXd residual() const { return end_.z - z_; }

  /// The direction along the joints, with its image.  Of one that grows, the smallest of the differences forwards,
  /// backwards and central: those across a jump of the steps are larger.
  std::pair<VectorXd, VectorXd> difference(const VectorXd &x) const
  {
    const auto [d, ahead] = difference_along(x);
    if (ahead.norm() <= d.norm())
      return {d, ahead};
    const VectorXd behind = -difference_along(-x).second, central = 0.5 * (ahead + behind);
    return {d, std::min({ahead, behind, central},
                        [](const VectorXd &a, const VectorXd &b) { return a.norm() < b.norm(); })};
  }

  /// Adds x across the directions so far.  False: the joints leave nothing of it.
  bool add(VectorXd x)
  {
    x.normalize();
    x                     = across(x);
    constexpr double none = 1e-8; // part of a direction that is rounding
    if (!(x.norm() > none))
      return false;
    const auto [d, y]        = difference(x.normalized());
    const double     rest    = across(d).norm();
    constexpr double by_rest = 1e-3; // of a unit: what joints leave of a direction across those that they allow
    if (!(rest > by_rest))
      return false;
    D_.conservativeResize(z_.size(), size() + 1);
    Y_.conservativeResize(z_.size(), D_.cols());
    D_.rightCols(1) = d;
    Y_.rightCols(1) = y;
    inverse_        = lu_solution(D_.transpose() * D_, D_.transpose());
    return true;
  }

  MatrixXd derivative() const { return Y_ * inverse_; }

  /// Takes Ritz values, and finds the residual of the worst of those that are not known well [2n]; empty: none.
  VectorXd worst_residual()
  {
    ritz_ = std::make_unique<GeneralEigenSolver>(MatrixXd(inverse_ * Y_));
    VectorXd     worst;
    double       excess  = 1.;
    const double largest = ritz_->eigenvalues().cwiseAbs().maxCoeff();
    for (Index k = 0; k < ritz_->eigenvalues().size(); ++k)
    {
      const std::complex<double> mu   = ritz_->eigenvalues()[k];
      const double               size = std::abs(mu);
      const Eigen::VectorXcd     w = ritz_->eigenvectors().col(k), y = D_ * w, left = Y_ * w - mu * y;
      constexpr double           told = 0.01, decided = 0.1, decides = 0.7, exact = 10. * step;
      double                     tolerance = size > share ? told : share;
      if (size >= decides * largest)
        tolerance = std::max(exact, std::min(told, decided * std::abs(size - 1.)));
      if (const double ratio = left.norm() / (tolerance * y.norm()); ratio > excess)
      {
        excess = ratio;
        worst  = left.real();
        if (left.imag().norm() > worst.norm())
          worst = left.imag();
      }
    }
    return worst;
  }

  /// Of the last Ritz values: what a period leaves large, at least of the largest value.
  MatrixXd large() const
  {
    const double least = std::min(share, ritz_->eigenvalues().cwiseAbs().maxCoeff());
    MatrixXd     z(z_.size(), 0);
    for (Index k = 0; k < ritz_->eigenvalues().size(); ++k)
    {
      const std::complex<double> mu = ritz_->eigenvalues()[k];
      if (std::abs(mu) < least || mu.imag() < 0.)
        continue;
      const Eigen::VectorXcd y = D_ * ritz_->eigenvectors().col(k);
      z.conservativeResize(Eigen::NoChange, z.cols() + (mu.imag() > 0. ? 2 : 1));
      z.rightCols(1) = y.real();
      if (mu.imag() > 0.)
        z.col(z.cols() - 2) = y.imag();
    }
    return orthonormal_columns(z, z.cols());
  }

private:
  std::pair<VectorXd, VectorXd> difference_along(const VectorXd &x) const
  {
    constexpr double least = 1e-3; // of the step: less is rounding, and the motion touches where an event begins
    const double     most  = step / x.cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
    for (double delta = most;; delta *= 0.1)
    {
      const VectorXd moved = nearest_(z_ + delta * x) - place_;
      const End      end   = passage_(z_ + moved);
      if (end.events == end_.events || delta <= least * most)
        return {moved / delta, (end.z - end_.z) / delta};
    }
  }

  VectorXd across(const VectorXd &x) const { return size() > 0 ? VectorXd(x - D_ * (inverse_ * x)) : x; }

  VectorXd                            z_, sizes_;
  const Passage                      &passage_;
  const Map                          &nearest_;
  End                                 end_;
  VectorXd                            place_;
  MatrixXd                            D_, Y_, inverse_; ///< D^+
  std::unique_ptr<GeneralEigenSolver> ritz_;
};

MatrixXd PassageDifferences::monodromy(const VectorXd &z, const End &end, const VectorXd &sizes, const Passage &passage,
                                       const Map &nearest)
{
  Space space(z, end, sizes, passage, nearest);
  for (Index k = 0; k < directions_.cols(); ++k)
    space.add(directions_.col(k));
  std::mt19937                     random(1); // the same in every call: a motion has one matrix
  std::normal_distribution<double> normal;
  VectorXd                         next = space.residual().stableNormalized();
  next += VectorXd::NullaryExpr(z.size(), [&](Index) { return normal(random); }).normalized();
  for (bool grows = true; grows && next.size() > 0;)
  {
    grows = space.add(next);
    if (space.size() == 0)
      return MatrixXd::Zero(z.size(), z.size()); // joints hold everything
    next = space.worst_residual();
  }
  directions_ = space.large();
  return space.derivative();
}

MatrixXd PassageDifferences::images(const VectorXd &z, const End &end, const VectorXd &sizes, const Passage &passage,
                                    const Map &nearest, const MatrixXd &x)
{
  const Space space(z, end, sizes, passage, nearest);
  MatrixXd    images(x.rows(), x.cols());
  for (Index k = 0; k < x.cols(); ++k)
    images.col(k) = space.difference(x.col(k)).second;
  return images;
}

} // namespace gestell::coupling
