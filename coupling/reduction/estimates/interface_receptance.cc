#include "coupling/reduction/estimates/interface_receptance.h"

#include "coupling/integration/system/dense_solvers.h"

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
using Complex   = std::complex<double>;
using Fractions = InterfaceReceptance::Fractions;

/**
 * Gaussian quadrature with the moments A = sum f f^T and B = sum f f^T nu of a sum whose nu lie in [0, highest]: of
 * s below 1 / highest it is a lower bound.  Directions in which A is negligible are left out.
 */
Fractions gauss(const MatrixXd &A, const MatrixXd &B, double highest, double negligible)
{
  const SymmetricEigenSolver a(A);
  const auto                 kept = (a.eigenvalues().array() > negligible).count();
  if (kept == 0)
    return {MatrixXd(A.rows(), 0), VectorXd(0)};
  const VectorXd             root = a.eigenvalues().tail(kept).cwiseSqrt();
  const MatrixXd             U    = a.eigenvectors().rightCols(kept);
  const MatrixXd             W    = U * root.cwiseInverse().asDiagonal();
  const SymmetricEigenSolver b(W.transpose() * B * W);
  return {U * root.asDiagonal() * b.eigenvectors(), b.eigenvalues().cwiseMax(0.).cwiseMin(highest)};
}

} // namespace

std::vector<ReceptanceFrequency> receptance_frequencies(const RefinedModes &refined, const fem::ModalRatios &zeta,
                                                        double highest)
{
  constexpr double nominal_zeta = 0.01; // of frames without damping, as of welded steel
  const auto       ratio        = [&](int mode, double omega)
  { return zeta.any() ? std::max(1e-4, zeta.at(mode, omega)) : nominal_zeta; };
  std::vector<ReceptanceFrequency> result;
  int                              mode   = 0;
  constexpr int                    spread = 100; // frequencies all over the range, besides those about modes
  for (int i = 1; i <= spread; ++i)
  {
    const double omega = highest * i / spread;
    while (mode + 1 < refined.omega.size() && refined.omega(mode + 1) <= omega)
      ++mode;
    result.push_back({omega, ratio(mode, omega)});
  }
  // half widths
  constexpr double around[] = {-3., -2., -1.5, -1., -0.7, -0.4, -0.2, 0., 0.2, 0.4, 0.7, 1., 1.5, 2., 3.};
  for (int j = 0; j < refined.omega.size() && refined.omega(j) <= 1.05 * highest; ++j)
    for (const double t : around)
    {
      const double width = ratio(j, refined.omega(j)), omega = refined.omega(j) * (1. + t * width);
      if (omega > 0. && omega <= highest)
        result.push_back({omega, width});
    }
  return result;
}

MatrixXcd Fractions::at(Complex s) const
{
  const MatrixXcd f = F.cast<Complex>();
  return f * (1. / (1. - s * nu.array().cast<Complex>())).matrix().asDiagonal() * f.transpose();
}

InterfaceReceptance::InterfaceReceptance(const ReductionBasis &basis, const ReducedMatrices &star,
                                         const ResidualFlexibility &response, const RefinedModes &refined,
                                         const fem::ModalRatios &zeta, double highest)
    : omega0_(basis.omega0)
{
  const int n1 = basis.n1(), m = basis.m();
  assert(n1 > 0);
  const VectorXd scale =
      star.M.topLeftCorner(n1, n1).diagonal().unaryExpr([](double x) { return x > 0. ? 1. / std::sqrt(x) : 1.; });
  const auto scaled = [&](const MatrixXd &A) -> MatrixXd { return scale.asDiagonal() * A * scale.asDiagonal(); };
  C11_              = scaled(star.C.topLeftCorner(n1, n1));
  M11_              = scaled(star.M.topLeftCorner(n1, n1));
  G_                = scale.asDiagonal() * star.M.topRightCorner(n1, m);
  moments_          = {scaled(response.Psi_M_X), scaled(response.X_M_X), scaled(response.X_M_X2)};

  // R beyond the modes known, whose nu lie below `last`
  const double    last = m > 0 ? 1. / (omega0_(m - 1) * omega0_(m - 1)) : 0.;
  const MatrixXd  P1 = moment(1, m), P2 = moment(2, m), P3 = moment(3, m);
  const Fractions known = of_modes(m), low = gauss(P2, P3, last, negligible(2)),
                  high = gauss(last * P1 - P2, last * P2 - P3, last, negligible(2));
  for (const auto &[omega, ratio] : receptance_frequencies(refined, zeta, highest))
  {
    const Complex   s     = omega * omega / Complex(1., 2. * ratio);
    const MatrixXcd lower = P1 + s * low.at(s), upper = (P1 - s * high.at(s)) / (1. - s * last);
    const MatrixXcd middle = receptance(s, known.at(s) + 0.5 * (lower + upper));
    const auto      off    = [&](const MatrixXcd &R) { return relative_error(receptance(s, known.at(s) + R), middle); };
    frequencies_.push_back({s, middle, std::max(off(lower), off(upper))});
  }
}

/// P_k of the modes beyond the first m.
MatrixXd InterfaceReceptance::moment(int k, int m) const
{
  const MatrixXd G = G_.leftCols(m);
  return moments_[k - 1] - G * omega0_.head(m).array().pow(-2 * k).matrix().asDiagonal() * G.transpose();
}

/// Rounding of P_k.
double InterfaceReceptance::negligible(int k) const
{
  constexpr double least_moment = 1e-12; // of a moment, relative to that of all modes: rounding of their sum
  return least_moment * moments_[k - 1].trace();
}

Fractions InterfaceReceptance::of_modes(int m) const
{
  const VectorXd inverse = omega0_.head(m).cwiseInverse();
  return {G_.leftCols(m) * inverse.asDiagonal(), inverse.cwiseAbs2()};
}

/// Partial fractions of the shapes X without their modes: W^T C W = P_1 = (M W)^T Psi,  W^T M W = P_2.
Fractions InterfaceReceptance::of_shapes(int m) const
{
  return gauss(moment(1, m), moment(2, m), m > 0 ? 1. / (omega0_(m - 1) * omega0_(m - 1)) : INFINITY, negligible(1));
}

Fractions InterfaceReceptance::of_model(int m, Inside inside) const
{
  Fractions model = of_modes(m);
  if (inside == Inside::modes)
    return model;
  const Fractions shapes = of_shapes(m);
  MatrixXd        F(model.F.rows(), model.F.cols() + shapes.F.cols());
  VectorXd        nu(F.cols());
  F << model.F, shapes.F;
  nu << model.nu, shapes.nu;
  return {std::move(F), std::move(nu)};
}

/// Receptance H for an internal part with dynamic stiffness D = C*_11 - s M*_11 - s^2 R, scaled.
MatrixXcd InterfaceReceptance::receptance(Complex s, const MatrixXcd &R) const
{
  return (C11_.cast<Complex>() - s * M11_.cast<Complex>() - s * s * R).partialPivLu().inverse();
}

double InterfaceReceptance::error_at(const Frequency &frequency, const Fractions &model) const
{
  return relative_error(receptance(frequency.s, model.at(frequency.s)), frequency.H);
}

double InterfaceReceptance::error(int m, Inside inside) const
{
  const Fractions model   = of_model(m, inside);
  double          largest = 0.;
  for (const Frequency &frequency : frequencies_)
    largest = std::max(largest, error_at(frequency, model));
  return largest;
}

double relative_error(const MatrixXcd &H_model, const MatrixXcd &H)
{
  const double error = (H_model - H).norm() / H.norm();
  return std::isnan(error) ? INFINITY : error;
}

void raise_errors(const Groups &groups, const MatrixXcd &H_model, const MatrixXcd &H, std::vector<double> &errors)
{
  errors.resize(groups.size(), 0.);
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    errors[i] = std::max(errors[i], relative_error(H_model(groups[i], groups[i]), H(groups[i], groups[i])));
  }
}

std::vector<double> InterfaceReceptance::errors_of(const Groups &groups, int m, Inside inside) const
{
  const Fractions     model = of_model(m, inside);
  std::vector<double> errors(groups.size(), 0.);
  for (const Frequency &frequency : frequencies_)
    raise_errors(groups, receptance(frequency.s, model.at(frequency.s)), frequency.H, errors);
  return errors;
}

InsideCount InterfaceReceptance::fewest(double tolerance, Inside inside) const
{
  std::size_t worst = 0; // where the last number failed, the next one probably fails too
  for (int m = 0; m <= omega0_.size(); ++m)
  {
    const Fractions model = of_model(m, inside);
    std::size_t     tried = 0;
    while (tried < frequencies_.size() && error_at(frequencies_[worst], model) <= tolerance)
      ++tried, worst = (worst + 1) % frequencies_.size();
    if (tried == frequencies_.size())
      return {m, int(model.nu.size()) - m};
  }
  return {};
}

double InterfaceReceptance::uncertainty() const
{
  double largest = 0.;
  for (const Frequency &frequency : frequencies_)
    largest = std::max(largest, frequency.doubt);
  return largest;
}

} // namespace gestell::coupling
