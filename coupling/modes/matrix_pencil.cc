#include "coupling/modes/matrix_pencil.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Each signal about its mean, divided by its range.
MatrixXd scaled(const MatrixXd &samples, VectorXd &range)
{
  MatrixXd y = samples.rowwise() - samples.colwise().mean();
  range      = y.cwiseAbs().colwise().maxCoeff();
  for (Index s = 0; s < y.cols(); ++s)
    y.col(s) /= range[s] > 0. ? range[s] : 1.;
  return y;
}

MatrixXd hankel(const MatrixXd &y)
{
  const Index n = y.rows(), L = n / 2;
  MatrixXd    Y(y.cols() * (n - L), L + 1);
  for (Index s = 0; s < y.cols(); ++s)
    for (Index i = 0; i < n - L; ++i)
      Y.row(s * (n - L) + i) = y.col(s).segment(i, L + 1).transpose();
  return Y;
}

/// z of the exponentials z^k.  Right singular vectors of Y are eigenvectors of Y^T Y: those kept lose eps / weakest^2,
/// 2e-8.
VectorXcd poles(const MatrixXd &y)
{
  const MatrixXd                       Y = hankel(y);
  const coupling::SymmetricEigenSolver squares(Y.transpose() * Y);
  const VectorXd   squared    = squares.eigenvalues().reverse(); // of the singular values, largest first
  constexpr double weakest    = 1e-4; // singular value / the largest one: retained ones lose eps / weakest^2 = 2e-8
  constexpr Index  most_poles = 40;   // of twenty modes
  Index            r          = 0;
  while (r < std::min(squared.size() - 1, most_poles) && squared[r] > weakest * weakest * squared[0])
    ++r;
  const MatrixXd V = squares.eigenvectors().rightCols(r);
  const MatrixXd A = coupling::LeastSquaresSolver(V.topRows(V.rows() - 1)).solve(V.bottomRows(V.rows() - 1));
  return coupling::GeneralEigenSolver(A, coupling::WithVectors::no).eigenvalues();
}

/// The rows z^k as cosines and sines, so that the fit stays real: [n x poles].
MatrixXd real_basis(const VectorXcd &z, Index n)
{
  MatrixXd  basis(n, z.size());
  VectorXcd power = VectorXcd::Ones(z.size());
  for (Index k = 0; k < n; ++k, power = power.cwiseProduct(z))
    for (Index j = 0; j < z.size(); ++j)
      basis(k, j) = z[j].imag() >= 0. ? power[j].real() : power[j].imag(); // one of each conjugate pair
  return basis;
}

/// Amplitudes [signals] of pole j from the coefficients of its cosine and of the sine of its conjugate.
VectorXcd amplitudes_of(Index j, const VectorXcd &z, const MatrixXd &coefficients)
{
  Index conjugate = 0;
  (z.array() - std::conj(z[j])).abs().minCoeff(&conjugate);
  VectorXcd A(coefficients.cols());
  A.real() = coefficients.row(j).transpose();
  A.imag() = coefficients.row(conjugate).transpose(); // Im conj(z)^k = -Im z^k
  return A;
}

} // namespace

double DampedOscillation::frequency_hz() const
{
  return s.imag() / (2. * M_PI);
}

double DampedOscillation::damping_ratio() const
{
  return -s.real() / std::abs(s);
}

PencilFit matrix_pencil(const MatrixXd &samples, double h, int most)
{
  constexpr Index fewest = 16; // samples: a window of 8 columns for four poles and as many of noise
  if (samples.rows() < fewest || samples.cols() < 1 || !(h > 0.))
    throw std::invalid_argument("matrix_pencil: " + std::to_string(samples.rows()) + " samples; at least " +
                                std::to_string(fewest) + " samples at equal time steps are needed");
  VectorXd       range;
  const MatrixXd y = scaled(samples, range);
  PencilFit      fit;
  if (range.maxCoeff() == 0.)
    return fit;
  const VectorXcd z            = poles(y);
  const MatrixXd  basis        = real_basis(z, y.rows());
  const MatrixXd  coefficients = coupling::LeastSquaresSolver(basis).solve(y);
  fit.residual                 = (y - basis * coefficients).norm() / y.norm();

  std::vector<std::pair<double, DampedOscillation>> found;
  for (Index j = 0; j < z.size(); ++j)
    if (z[j].imag() > 0.)
    {
      VectorXcd    A        = amplitudes_of(j, z, coefficients);
      const double strength = A.norm();
      A                     = A.cwiseProduct(range);
      found.emplace_back(strength, DampedOscillation{std::log(z[j]) / h, A, strength});
    }
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.first > b.first; });
  for (std::size_t i = 0; i < std::min(found.size(), std::size_t(std::max(0, most))); ++i)
    fit.oscillations.push_back(found[i].second);
  std::sort(fit.oscillations.begin(), fit.oscillations.end(),
            [](const auto &a, const auto &b) { return a.s.imag() < b.s.imag(); });
  return fit;
}

} // namespace gestell::coupling
