#include "coupling/periodic/response/unstable_modes.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

struct Matrices
{
  MatrixXd M, B, C;

  MatrixXd Z(double sigma) const { return C + sigma * B + sigma * sigma * M; }
};

bool is_symmetric(const MatrixXd &A)
{
  constexpr double symmetric = 1e-12; // difference from the transpose, of the largest entry
  return (A - A.transpose()).cwiseAbs().maxCoeff() <= symmetric * A.cwiseAbs().maxCoeff();
}

/// Whether the symmetric part has no negative eigenvalue, by Cholesky's factor at unit diagonal.
bool is_nowhere_negative(const MatrixXd &A)
{
  MatrixXd S     = 0.5 * (A + A.transpose());
  VectorXd scale = VectorXd::Ones(S.rows());
  for (Index i = 0; i < S.rows(); ++i)
    if (S(i, i) < 0. || (S(i, i) == 0. && !S.row(i).isZero(0.)))
      return false;
    else if (S(i, i) > 0.)
      scale[i] = 1. / std::sqrt(S(i, i));
  S                         = scale.asDiagonal() * S * scale.asDiagonal();
  constexpr double rounding = 1e-11; // eigenvalue of a matrix of unit diagonal that is no less than zero
  S.diagonal().array() += rounding;
  return S.llt().info() == Eigen::Success;
}

/// The theorem of Kelvin, Tait and Chetaev: gyroscopic forces and dampers do not unsettle what springs hold.
bool is_held_and_damped(const Matrices &of)
{
  return is_symmetric(of.M) && is_symmetric(of.C) && is_nowhere_negative(of.M) && is_nowhere_negative(of.C) &&
         is_nowhere_negative(of.B);
}

/// Geometric mean of sqrt(C_ii/M_ii) [1/s].
double middle_speed(const Matrices &of)
{
  double sum   = 0.;
  int    count = 0;
  for (Index i = 0; i < of.M.rows(); ++i)
    if (of.M(i, i) > 0. && of.C(i, i) != 0.)
    {
      sum += 0.5 * std::log(std::abs(of.C(i, i)) / of.M(i, i));
      ++count;
    }
  constexpr double beside_nothing = 1.234; // keeps sigma off the eigenvalues of plain examples
  return beside_nothing * (count > 0 ? std::exp(sum / count) : 1.);
}

/// The same in coordinates that G leaves free, scaled to a unit diagonal of Z before.
Matrices free_coordinates(const Matrices &of, const MatrixXd &G, double sigma)
{
  VectorXd scale = of.Z(sigma).diagonal().cwiseAbs();
  for (double &size : scale)
    size = size > 0. ? 1. / std::sqrt(size) : 1.;
  MatrixXd basis = scale.asDiagonal();
  if (G.rows() > 0)
  {
    MatrixXd rows = G * basis;
    for (Index e = 0; e < rows.rows(); ++e)
      if (const double size = rows.row(e).norm(); size > 0.)
        rows.row(e) /= size;
    constexpr double dependent = 1e-10; // rows of G that others contain
    basis                      = basis * LeastSquaresSolver(rows, dependent).null_space();
  }
  const auto projected = [&](const MatrixXd &A) { return MatrixXd(basis.transpose() * A * basis); };
  return {projected(of.M), projected(of.B), projected(of.C)};
}

/// The matrix with the eigenvalues theta [2 m x 2 m].
MatrixXd inverted(const Matrices &of, double sigma)
{
  const Index    m       = of.M.rows();
  const MatrixXd inertia = sigma * sigma * of.M, both = sigma * of.B + inertia;
  MatrixXd       right(m, 2 * m), T(2 * m, 2 * m);
  right << both, inertia;
  T.topRows(m)    = -lu_solution(of.Z(sigma), right);
  T.bottomRows(m) = T.topRows(m);
  T.bottomLeftCorner(m, m).diagonal().array() += 1.;
  return T;
}

bool grows(const Complex &s, double sigma)
{
  constexpr double at_rest      = 1e-6; // |s| / sigma: a double root at rest parts by the root of rounding, 1e-8
  constexpr double least_growth = 1e-7; // Re s / |s|: two that nearly meet part by the root of rounding, 1e-8
  return std::abs(s) > at_rest * sigma && s.imag() >= 0. && s.real() > least_growth * std::abs(s);
}

} // namespace

std::optional<std::vector<Complex>> unstable_modes(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C,
                                                   const MatrixXd &G)
{
  const Matrices       whole{M, B, C};
  std::vector<Complex> found;
  if (M.rows() == 0 || is_held_and_damped(whole))
    return found;
  const double   sigma = middle_speed(whole);
  const Matrices free  = free_coordinates(whole, G, sigma);
  if (free.M.rows() == 0 || is_held_and_damped(free))
    return found;
  constexpr Index most_coordinates = 400; // eigenvalues of twice as many states take some seconds
  if (free.M.rows() > most_coordinates)
    return std::nullopt;
  const MatrixXd T = inverted(free, sigma);
  if (!T.allFinite())
    return std::nullopt;
  const GeneralEigenSolver solver(T, WithVectors::no);
  if (!solver.converged())
    return std::nullopt;
  constexpr double no_mass = 3e-5; // |theta|: infinite s, of which rounding leaves its cube root in chains of three
  for (const Complex &theta : solver.eigenvalues())
    if (std::abs(theta) > no_mass)
      if (const Complex s = sigma * (1. + 1. / theta); grows(s, sigma))
        found.push_back(s);
  std::sort(found.begin(), found.end(), [](const Complex &a, const Complex &b) { return a.real() > b.real(); });
  return found;
}

} // namespace gestell::coupling
