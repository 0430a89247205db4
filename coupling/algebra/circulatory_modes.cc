#include "coupling/algebra/circulatory_modes.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

using Complex = std::complex<double>;

/// Normalises z: z^H M z = 1, and the phase such that Re z is orthogonal to Im z and not shorter.
void normalise(const MatrixXd &M, Eigen::VectorXcd &z)
{
  z /= std::sqrt(z.dot(M * z).real());
  z *= std::polar(1., -0.5 * std::arg(z.conjugate().dot(M * z)));
}

/// One of the two columns of a pair, Re z or Im z of unit length, and its row of the dual basis.
void set_column(const MatrixXd &M, const VectorXd &part, const VectorXd &dual, Eigen::Index j, CirculatoryModes &found)
{
  const double size    = std::sqrt(part.dot(M * part));
  found.modes.V.col(j) = part / size;
  found.left.col(j)    = dual * size;
}

/// lambda real.
void set_real(const MatrixXd &C, const MatrixXd &M, double lambda, const VectorXd &z, const VectorXd &w, Eigen::Index j,
              CirculatoryModes &found)
{
  const VectorXd v = z / std::sqrt(z.dot(M * z)), left = w / w.dot(M * v);
  // condition of lambda, |left| |v|: above it rounding exceeds the correction
  constexpr double most_sensitive = 1e3;
  if (left.dot(M * left) < most_sensitive * most_sensitive)
    lambda = left.dot(C * v);          // stationary, so that it has more digits than its vectors
  constexpr double rest_share = 1e-28; // of the greatest |C_ii| |v|^2: what v, rounded to 1e-14, leaves
  const double     rest       = rest_share * C.diagonal().cwiseAbs().maxCoeff() * v.cwiseAbs().dot(left.cwiseAbs());
  const double     rounding = std::max(cancelled_by_rounding * left.cwiseAbs().dot(C.cwiseAbs() * v.cwiseAbs()), rest);
  found.modes.V.col(j)      = v;
  found.left.col(j)         = left;
  found.modes.omega(j)      = lambda > rounding ? std::sqrt(lambda) : 0.;
  constexpr double surely   = 1e3; // times what rounding leaves: a rigid motion is not said to grow
  found.modes.growth(j)     = -lambda > surely * rounding ? std::sqrt(-lambda) : 0.;
}

/// lambda and its conjugate: columns j and j + 1.
void set_pair(const MatrixXd &M, const Complex &lambda, bool flutters, Eigen::VectorXcd z, Eigen::VectorXcd w,
              Eigen::Index j, CirculatoryModes &found)
{
  normalise(M, z);
  w /= (w.transpose() * (M * z))(0);
  set_column(M, z.real(), 2. * w.real(), j, found);
  set_column(M, z.imag(), -2. * w.imag(), j + 1, found);
  const Complex s      = flutters ? std::sqrt(-lambda) : Complex(0., std::sqrt(std::max(0., lambda.real())));
  const double  falls  = !flutters && lambda.real() < 0. ? std::sqrt(-lambda.real()) : 0.;
  found.modes.omega(j) = found.modes.omega(j + 1) = std::abs(s.imag());
  found.modes.growth(j)                           = std::max(s.real(), falls);
  found.modes.growth(j + 1)                       = flutters ? -s.real() : falls;
}

/// Sorts by frequency; unstable modes come first.
void sort_by_frequency(CirculatoryModes &found)
{
  std::vector<int> order(std::size_t(found.modes.omega.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return found.modes.omega[a] < found.modes.omega[b]; });
  found = {{found.modes.omega(order).eval(), found.modes.V(Eigen::all, order).eval(), found.modes.growth(order).eval()},
           found.left(Eigen::all, order).eval()};
}

/// Smallest s, up to a factor, that makes S + s M positive definite; S symmetric.
double shift_of(const MatrixXd &S, const MatrixXd &M)
{
  const DenseModes modes  = dense_modes(S, M);
  double           lowest = 0.;
  for (const double omega : modes.omega)
    if (omega > 0. && (lowest == 0. || omega < lowest))
      lowest = omega;
  const bool   regular = modes.omega.size() > 0 && modes.omega.minCoeff() > 0.;
  const double fastest = modes.growth.size() > 0 ? modes.growth.maxCoeff() : 0.;
  const double s       = std::max(lowest * lowest, 2. * fastest * fastest);
  return regular ? 0. : s > 0. ? s : 1.;
}

} // namespace

CirculatoryModes circulatory_modes(const MatrixXd &C, const MatrixXd &M)
{
  if (C.rows() == 0)
    return {};
  const MatrixXd S      = 0.5 * (C + C.transpose());
  const double   s      = shift_of(S, M);
  const VectorXd scale  = (S + s * M).diagonal().unaryExpr([](double a) { return a > 0. ? 1. / std::sqrt(a) : 1.; });
  const MatrixXd scaled = scale.asDiagonal() * (C + s * M) * scale.asDiagonal();
  const GeneralEigenSolver solver(lu_solution(scaled, MatrixXd(scale.asDiagonal() * M * scale.asDiagonal())));
  const Eigen::VectorXcd  &m = solver.eigenvalues();
  const Eigen::MatrixXcd   Z = scale.asDiagonal() * solver.eigenvectors();
  // Rows w^T of the dual basis: Y^-1 (C + s M)^-1.
  const Eigen::MatrixXcd rows =
      solver.eigenvectors().partialPivLu().solve(lu_solution(scaled, MatrixXd(scale.asDiagonal())).cast<Complex>());
  const double largest = m.cwiseAbs().maxCoeff();
  const auto   n       = m.size();
  // mu relative to the largest, below which a mode has no mass, as in dense_modes()
  constexpr double no_mass = 1e-13;
  const auto       moves   = [&](Eigen::Index i) { return std::abs(m[i]) > no_mass * largest; };
  Eigen::Index     p       = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    p += moves(i) ? 1 : 0;
  CirculatoryModes found{{VectorXd::Zero(p), MatrixXd::Zero(n, p), VectorXd::Zero(p)}, MatrixXd::Zero(n, p)};
  Eigen::Index     j = 0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    if (!moves(i) || m[i].imag() < 0.) // of a pair one
      continue;
    const Complex lambda = 1. / m[i] - s;
    if (m[i].imag() == 0.)
      set_real(C, M, lambda.real(), Z.col(i).real(), rows.row(i).real().transpose(), j++, found);
    else
    {
      // |Im lambda| of |lambda| + s: two real ones that meet part by the root of rounding
      constexpr double meet = 1e-9;
      set_pair(M, lambda, std::abs(lambda.imag()) > meet * (std::abs(lambda) + s), Z.col(i), rows.row(i).transpose(), j,
               found);
      j += 2;
    }
  }
  sort_by_frequency(found);
  return found;
}

} // namespace gestell::coupling
