#include "coupling/reduction/interface_receptance.h"

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double nominal_zeta = 0.01;
constexpr int    spread       = 100; // frequencies all over the range
constexpr double around[] = {-3., -2., -1.5, -1., -0.7, -0.4, -0.2, 0., 0.2, 0.4, 0.7, 1., 1.5, 2., 3.}; // half widths

/// Frequencies to look at, each with its damping ratio.
std::vector<std::pair<double, double>> frequencies_of(const SupportedModes &refined, const fem::ModalRatios &zeta,
                                                      double highest)
{
  const auto ratio = [&](int mode, double omega)
  { return zeta.any() ? std::max(1e-4, zeta.at(mode, omega)) : nominal_zeta; };
  std::vector<std::pair<double, double>> result;
  int                                    mode = 0;
  for (int i = 1; i <= spread; ++i)
  {
    const double omega = highest * i / spread;
    while (mode + 1 < refined.omega.size() && refined.omega(mode + 1) <= omega)
      ++mode;
    result.emplace_back(omega, ratio(mode, omega));
  }
  for (int j = 0; j < refined.omega.size() && refined.omega(j) <= 1.05 * highest; ++j)
    for (const double t : around)
    {
      const double width = ratio(j, refined.omega(j)), omega = refined.omega(j) * (1. + t * width);
      if (omega > 0. && omega <= highest)
        result.emplace_back(omega, width);
    }
  return result;
}

} // namespace

InterfaceReceptance::InterfaceReceptance(const ReductionBasis &basis, const ReducedMatrices &star,
                                         const InteriorResponse &response, const SupportedModes &refined,
                                         const fem::ModalRatios &zeta, double highest)
    : omega0_(basis.omega0)
{
  const int n1 = basis.n1(), m = basis.m();
  assert(n1 > 0);
  const VectorXd scale =
      star.M.topLeftCorner(n1, n1).diagonal().unaryExpr([](double x) { return x > 0. ? 1. / std::sqrt(x) : 1.; });
  C11_ = scale.asDiagonal() * star.C.topLeftCorner(n1, n1) * scale.asDiagonal();
  M11_ = scale.asDiagonal() * star.M.topLeftCorner(n1, n1) * scale.asDiagonal();
  G_   = scale.asDiagonal() * star.M.topRightCorner(n1, m);

  const VectorXd squares = omega0_.cwiseAbs2();
  const MatrixXd first   = scale.asDiagonal() * response.Psi_M_X * scale.asDiagonal();
  const MatrixXd second  = scale.asDiagonal() * response.X_M_X * scale.asDiagonal();
  const MatrixXd P1      = first - G_ * squares.cwiseInverse().asDiagonal() * G_.transpose();
  const MatrixXd P2      = second - G_ * squares.cwiseAbs2().cwiseInverse().asDiagonal() * G_.transpose();
  for (const auto &[omega, ratio] : frequencies_of(refined, zeta, highest))
  {
    const Complex s    = omega * omega / Complex(1., 2. * ratio);
    const double  more = m > 0 && omega < omega0_(m - 1) ? 1. / (1. - omega * omega / squares(m - 1)) : 1.; // of P2
    const auto    H    = [&](double share) -> MatrixXcd
    { return (stiffness(s, m) - s * s * (P1 + s * share * P2)).partialPivLu().inverse(); };
    const MatrixXcd middle = H(0.5 * (1. + more));
    frequencies_.push_back({s, middle, middle.norm(), (H(more) - middle).norm() / middle.norm()});
  }
}

/// C*_11 - s M*_11 - s^2 sum over the first m modes, scaled.
MatrixXcd InterfaceReceptance::stiffness(Complex s, int m) const
{
  const Eigen::VectorXcd terms = (s * s / (omega0_.head(m).array().square().cast<Complex>() - s)).matrix();
  const MatrixXcd        G     = G_.leftCols(m).cast<Complex>();
  return C11_.cast<Complex>() - s * M11_.cast<Complex>() - G * terms.asDiagonal() * G.transpose();
}

double InterfaceReceptance::error_at(const Frequency &frequency, int m) const
{
  return (stiffness(frequency.s, m).partialPivLu().inverse() - frequency.H).norm() / frequency.size;
}

double InterfaceReceptance::error(int m) const
{
  double largest = 0.;
  for (const Frequency &frequency : frequencies_)
    largest = std::max(largest, error_at(frequency, m));
  return largest;
}

int InterfaceReceptance::fewest(double tolerance) const
{
  std::size_t worst = 0; // where the last number failed the next one will, too
  for (int m = 0; m <= omega0_.size(); ++m)
  {
    std::size_t tried = 0;
    while (tried < frequencies_.size() && error_at(frequencies_[worst], m) <= tolerance)
      ++tried, worst = (worst + 1) % frequencies_.size();
    if (tried == frequencies_.size())
      return m;
  }
  return -1;
}

double InterfaceReceptance::uncertainty() const
{
  double largest = 0.;
  for (const Frequency &frequency : frequencies_)
    largest = std::max(largest, frequency.doubt);
  return largest;
}

} // namespace gestell::coupling
