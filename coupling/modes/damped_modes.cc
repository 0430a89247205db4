#include "coupling/modes/damped_modes.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;

/// omega^2, negative for an unstable mode.
Eigen::VectorXd squares(const DenseModes &modes)
{
  return modes.omega.cwiseAbs2() - modes.growth.cwiseAbs2();
}

/// Sets of modes that are solved together.
class Groups
{
public:
  explicit Groups(Eigen::Index n) : root_(n) { std::iota(root_.begin(), root_.end(), 0); }

  Eigen::Index root(Eigen::Index i)
  {
    while (root_[i] != i)
      i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(Eigen::Index i, Eigen::Index j) { root_[root(i)] = root(j); }

  std::vector<std::vector<Eigen::Index>> sets()
  {
    std::vector<std::vector<Eigen::Index>> by_root(root_.size());
    for (Eigen::Index i = 0; i < Eigen::Index(root_.size()); ++i)
      by_root[root(i)].push_back(i);
    by_root.erase(std::remove_if(by_root.begin(), by_root.end(), [](const auto &set) { return set.empty(); }),
                  by_root.end());
    return by_root;
  }

private:
  std::vector<Eigen::Index> root_;
};

/// Effect of the coupling with another mode on s, relative to the tolerance.
struct Share
{
  double       amount;
  Eigen::Index other;
};

/// Both roots of s^2 + b s + square.
std::array<Complex, 2> roots(double b, double square)
{
  const Complex root = std::sqrt(Complex(0.25 * b * b - square));
  return {-0.5 * b + root, -0.5 * b - root};
}

/// Joins mode j with the modes to which its coupling cannot be neglected.
void join_coupled(Eigen::Index j, const Eigen::MatrixXd &B, const Eigen::VectorXd &square,
                  const CouplingTolerance &tolerance, std::vector<Share> &shares, Groups &groups)
{
  shares.clear();
  for (Eigen::Index i = 0; i < B.rows(); ++i)
    if (i != j && B(i, j) != 0.)
    {
      double amount = 0.;
      for (const Complex &s : roots(B(j, j), square[j]))
      {
        const Complex moved = B(i, j) * B(i, j) * s * s / ((2. * s + B(j, j)) * (s * s + B(i, i) * s + square[i]));
        const auto    part  = [](double of, double whole) { return of == 0. ? 0. : of / whole; };
        const double  own   = std::max(part(std::abs(moved), tolerance.of_s * std::abs(s)),
                                       part(std::abs(moved.real()), tolerance.of_decay * std::abs(s.real())));
        amount              = std::max(amount, std::isfinite(own) ? own : 2.); // roots that meet are joined
      }
      if (amount > 0.)
        shares.push_back({amount, i});
    }
  std::sort(shares.begin(), shares.end(), [](const Share &a, const Share &b) { return a.amount < b.amount; });
  double sum = 0.;
  for (const Share &share : shares)
    if ((sum += share.amount) > 1.)
      groups.join(j, share.other);
}

/// Adds s of a single mode.
void add_single(const DenseModes &modes, const Eigen::MatrixXd &B, Eigen::Index j, std::vector<DampedMode> &result)
{
  const double omega = modes.omega[j], zeta = 0.5 * B(j, j) / omega;
  if (omega > 0. && std::abs(zeta) < 1.)
    result.push_back({{omega, zeta}, j});
}

/// s of modes that are coupled.  In the state (Omega y, y') the matrix is as large as the highest frequency, so that
/// the lowest keep their digits.
void add_joined(const DenseModes &modes, const Eigen::MatrixXd &B, const std::vector<Eigen::Index> &joined,
                std::vector<DampedMode> &result)
{
  const auto      p = Eigen::Index(joined.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * p, 2 * p);
  for (Eigen::Index a = 0; a < p; ++a)
  {
    const double omega = modes.omega[joined[a]], growth = modes.growth[joined[a]];
    A(a, p + a) = growth > 0. ? growth : omega;
    A(p + a, a) = growth > 0. ? growth : -omega;
    for (Eigen::Index b = 0; b < p; ++b)
      A(p + a, p + b) = -B(joined[a], joined[b]);
  }
  const Eigen::VectorXcd s     = GeneralEigenSolver(A, WithVectors::no).eigenvalues();
  const double           noise = 1e-13 * double(p) * A.norm(); // of eigenvalues of a matrix of that norm
  for (const Complex &value : s)
    if (value.imag() > std::max(noise, 1e-9 * std::abs(value))) // two that meet part by the root of rounding
    {
      const auto nearer = [&](Eigen::Index a, Eigen::Index b)
      { return std::abs(modes.omega[a] - std::abs(value)) < std::abs(modes.omega[b] - std::abs(value)); };
      result.push_back({{std::abs(value), -value.real() / std::abs(value)},
                        *std::min_element(joined.begin(), joined.end(), nearer)});
    }
}

void require_finite_damping(const DenseModes &modes, const Eigen::MatrixXd &B)
{
  if (!B.allFinite() || !modes.omega.allFinite())
    throw std::invalid_argument(
        "damped_modes: the damping of a mode is not finite; a damper is far too large for a mass: check their units");
}

/// Sorts by |s|.
void sort_by_size(std::vector<DampedMode> &modes)
{
  std::sort(modes.begin(), modes.end(),
            [](const DampedMode &a, const DampedMode &b) { return a.line.omega < b.line.omega; });
}

/// The mode of nearest frequency that is not taken.
Eigen::Index take_nearest(const DenseModes &modes, double omega, std::vector<char> &taken)
{
  Eigen::Index best = -1;
  for (Eigen::Index j = 0; j < modes.omega.size(); ++j)
    if (!taken[std::size_t(j)] && (best < 0 || std::abs(modes.omega[j] - omega) < std::abs(modes.omega[best] - omega)))
      best = j;
  taken[std::size_t(best)] = true;
  return best;
}

} // namespace

/// Roots of the damped system, from the state (Omega y, y'), whose entries are as large as the highest frequency.
Eigen::VectorXcd damped_roots(const DenseModes &modes, const Eigen::MatrixXd &C, const Eigen::MatrixXd &B)
{
  require_finite_damping(modes, B);
  const Eigen::Index    p     = C.rows();
  const Eigen::VectorXd omega = (modes.omega.cwiseAbs2() + modes.growth.cwiseAbs2())
                                    .cwiseSqrt()
                                    .unaryExpr([](double x) { return x > 0. ? x : 1.; });
  Eigen::MatrixXd A         = Eigen::MatrixXd::Zero(2 * p, 2 * p);
  A.topRightCorner(p, p)    = omega.asDiagonal();
  A.bottomLeftCorner(p, p)  = -C * omega.cwiseInverse().asDiagonal();
  A.bottomRightCorner(p, p) = -B;
  return GeneralEigenSolver(A, WithVectors::no).eigenvalues();
}

std::vector<DampedMode> all_damped_modes(const DenseModes &modes, const Eigen::MatrixXd &C, const Eigen::MatrixXd &B)
{
  std::vector<DampedMode> result;
  for (const Complex &s : damped_roots(modes, C, B))
    if (s.imag() > 1e-9 * std::abs(s)) // two that meet part by the root of rounding
    {
      const double zeta = -s.real() / std::abs(s);
      result.push_back({{std::abs(s), std::abs(zeta) > rounding_of_ratio ? zeta : 0.}, 0});
    }
  sort_by_size(result);
  std::vector<char> taken(std::size_t(C.rows()), 0);
  for (DampedMode &mode : result)
    mode.nearest = take_nearest(modes, mode.line.omega, taken);
  return result;
}

std::vector<DampedMode> damped_modes(const DenseModes &modes, const Eigen::MatrixXd &B,
                                     const CouplingTolerance &tolerance)
{
  require_finite_damping(modes, B);
  const Eigen::VectorXd square = squares(modes);
  Groups                groups(B.rows());
  std::vector<Share>    shares;
  for (Eigen::Index j = 0; j < B.rows(); ++j)
    join_coupled(j, B, square, tolerance, shares, groups);
  std::vector<DampedMode> result;
  for (const std::vector<Eigen::Index> &set : groups.sets())
    if (set.size() == 1)
      add_single(modes, B, set[0], result);
    else
      add_joined(modes, B, set, result);
  sort_by_size(result);
  return result;
}

} // namespace gestell::coupling
