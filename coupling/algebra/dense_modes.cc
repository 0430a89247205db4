#include "coupling/algebra/dense_modes.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// 1 / sqrt of the diagonal, 1 where it is zero: makes metres and radians comparable.
VectorXd unit_diagonal(const MatrixXd &A)
{
  return A.diagonal().unaryExpr([](double a) { return a > 0. ? 1. / std::sqrt(a) : 1.; });
}

/// Smallest C_ii / M_ii above the rounding of the largest: an upper bound of the lowest nonzero omega^2. `floating` is
/// set if smaller ones were left out.
double lowest_quotient(const MatrixXd &C, const MatrixXd &M, double cancelled, bool &floating)
{
  VectorXd quotients(C.rows());
  int      n = 0;
  for (int i = 0; i < C.rows(); ++i)
    if (M(i, i) > 0. && std::isfinite(C(i, i) / M(i, i))) // others have no mass
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
  regular,  ///< no motion is free
  singular, ///< some are free
  unstable  ///< some are driven away: a linkage about to fall
};

Stiffness stiffness_of(const MatrixXd &C)
{
  const VectorXd             d = unit_diagonal(C);
  const SymmetricEigenSolver scaled(d.asDiagonal() * C * d.asDiagonal(), WithVectors::no);
  const VectorXd            &values = scaled.eigenvalues();
  // smallest eigenvalue of C scaled to unit diagonal, below which C counts as singular
  constexpr double rigid = 1e-11;
  return values.minCoeff() > rigid                                   ? Stiffness::regular
         : values.minCoeff() < -rigid * values.cwiseAbs().maxCoeff() ? Stiffness::unstable
                                                                     : Stiffness::singular;
}

/// C + s M scaled to unit diagonal, and its factor.
class Shifted
{
public:
  Shifted(const MatrixXd &C, const MatrixXd &M, double s)
  {
    const MatrixXd A = C + s * M;
    d_               = unit_diagonal(A);
    scaled_          = d_.asDiagonal() * A * d_.asDiagonal();
    L_.compute(scaled_);
  }

  bool definite() const { return L_.info() == Eigen::Success; }

  void require_motion() const
  {
    if (definite())
      return;
    int                        weakest;
    const SymmetricEigenSolver modes(scaled_);
    modes.eigenvectors().col(0).cwiseAbs().maxCoeff(&weakest);
    throw std::invalid_argument("dense_modes: DOF " + std::to_string(weakest) +
                                " has neither stiffness nor mass; give it one of them or remove the DOF");
  }

  /// M v = mu (C + s M) v, mu ascending: omega descending.
  VectorXd solve(const MatrixXd &M, MatrixXd &V) const
  {
    MatrixXd H = d_.asDiagonal() * M * d_.asDiagonal(); // H = L^-1 D M D L^-T
    L_.matrixL().solveInPlace(H);
    H = H.transpose().eval();
    L_.matrixL().solveInPlace(H);
    const SymmetricEigenSolver solver(H);
    V = solver.eigenvectors();
    L_.matrixU().solveInPlace(V);
    V = d_.asDiagonal() * V;
    return solver.eigenvalues();
  }

private:
  VectorXd             d_;
  MatrixXd             scaled_;
  Eigen::LLT<MatrixXd> L_;
};

DenseModes modes_of(const MatrixXd &C, const MatrixXd &M, const Shifted &shifted, double cancelled,
                    std::optional<int> n_rigid)
{
  MatrixXd       V;
  const VectorXd mu = shifted.solve(M, V);
  const int      n  = int(mu.size());
  // mu relative to the largest, below which a mode has no mass: 450 eps, rounding of a sum of as many terms
  constexpr double massless = 1e-13;
  int              p        = 0;
  while (p < n && mu(n - 1 - p) > massless * mu(n - 1))
    ++p;
  DenseModes modes{VectorXd(p), V.rightCols(p).rowwise().reverse(), VectorXd::Zero(p)};
  for (int j = 0; j < p; ++j)
  {
    auto v = modes.V.col(j);
    v /= std::sqrt(v.dot(M * v));
    const double     square   = v.dot(C * v);
    constexpr double at_rest  = 1e-28; // of the greatest C_ii |v|^2: what v, rounded to 1e-14, leaves of v^T C v
    const double     rest     = at_rest * C.diagonal().maxCoeff() * v.cwiseAbs2().maxCoeff();
    const double     rounding = std::max(cancelled * v.cwiseAbs().dot(C.cwiseAbs() * v.cwiseAbs()), rest);
    const bool       moves    = n_rigid ? j >= *n_rigid && square > 0. : square > rounding;
    modes.omega(j)            = moves ? std::sqrt(square) : 0.;
    constexpr double certain  = 1e3; // times what rounding leaves: a rigid motion is not said to grow
    if (-square > certain * rounding)
      modes.growth(j) = std::sqrt(-square);
  }
  return modes;
}

/// Highest omega^2 of several modes that cannot be distinguished because s is far above them; 0 if there are none.
double alike_beside(double s, const DenseModes &modes)
{
  constexpr double near = 1e-8; // omega^2 over s: below it s is too large to distinguish modes
  const auto       slow = [&](double omega) { return omega > 0. && omega * omega < near * s; };
  const auto       n    = std::count_if(modes.omega.begin(), modes.omega.end(), slow);
  if (n < 2)
    return 0.;
  double highest = 0.;
  for (const double omega : modes.omega)
    if (slow(omega))
      highest = std::max(highest, omega);
  return highest * highest;
}

} // namespace

DenseModes dense_modes(const MatrixXd &C, const MatrixXd &M, double cancelled, std::optional<int> n_rigid)
{
  if (C.rows() == 0)
    return {};
  if (!C.allFinite() || !M.allFinite())
    throw std::invalid_argument(
        "modes: a mass, a stiffness or a sum of them is not finite; check the units of very large numbers");
  bool            floating  = false;
  const double    lowest    = lowest_quotient(C, M, cancelled, floating);
  const Stiffness stiffness = stiffness_of(C);
  double          s         = !floating && stiffness == Stiffness::regular ? 0. : lowest;
  Shifted         shifted(C, M, s);
  constexpr int   most_shifts = 20; // times ten each: from rounding to far beyond the largest
  // The shift must outweigh the fastest fall, of rate sqrt(-omega^2).
  for (int i = 0; i < most_shifts && stiffness == Stiffness::unstable && !shifted.definite(); ++i)
    shifted = Shifted(C, M, s *= 10.);
  shifted.require_motion();
  DenseModes modes = modes_of(C, M, shifted, cancelled, n_rigid);
  for (int i = 0; i < most_shifts && stiffness != Stiffness::unstable; ++i)
  {
    s = alike_beside(s, modes);
    if (s == 0.)
      break;
    shifted = Shifted(C, M, s);
    if (!shifted.definite())
      break;
    modes = modes_of(C, M, shifted, cancelled, n_rigid);
  }
  return modes;
}

} // namespace gestell::coupling
