#include "coupling/integration/bdf_stability.h"

#include "coupling/integration/bdf_formula.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gestell::coupling
{

double bdf_spectral_radius(int order, const SpectrumLine &mode, double h)
{
  const BdfFormula          &formula   = bdf_formulas[order - 1];
  const std::complex<double> root      = std::sqrt(std::complex<double>(mode.zeta * mode.zeta - 1.));
  const std::complex<double> s         = mode.omega * (-mode.zeta + root);
  const std::complex<double> leading   = 1. - h * formula.beta0 * s;
  Eigen::MatrixXcd           companion = Eigen::MatrixXcd::Zero(order, order);
  for (int i = 0; i < order; ++i)
    companion(0, i) = -formula.alpha[i] / leading;
  for (int i = 1; i < order; ++i)
    companion(i, i - 1) = 1.;
  return Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues().cwiseAbs().maxCoeff();
}

std::optional<UnstableMode> unstable_mode(int order, const std::vector<SpectrumLine> &spectrum, double h)
{
  constexpr double            rounding = 1e-9; // of the simple root at 1 and of its neighbours
  std::optional<UnstableMode> worst;
  for (const SpectrumLine &mode : spectrum)
  {
    const double growth = bdf_spectral_radius(order, mode, h);
    if (growth > 1. + rounding && (!worst || growth > worst->growth))
      worst = UnstableMode{mode, growth};
  }
  return worst;
}

} // namespace gestell::coupling
