#include "coupling/integration/bdf/bdf_order_limit.h"

#include "coupling/integration/bdf/bdf_formula.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

/**
 * The polynomial a_0 + a_1 r + ... + a_p r^p has all roots in |r| < 1 exactly if |a_0| < |a_p| and the polynomial of
 * degree p - 1 with  b_j = conj(a_p) a_{j+1} - a_0 conj(a_{p-j-1})  has.
 */
bool bdf_decays(int order, const SpectrumLine &mode, double h)
{
  using Complex                  = std::complex<double>;
  constexpr double       radius  = 1. + 1e-9; // roots on the unit circle are stable, up to rounding
  const BdfFormula      &formula = bdf_formulas[order - 1];
  const Complex          s       = mode.omega * (-mode.zeta + std::sqrt(Complex(mode.zeta * mode.zeta - 1.)));
  std::array<Complex, 7> a, b;
  double                 power = 1.; // roots r / radius instead of r
  for (int j = 0; j <= order; ++j, power *= radius)
    a[j] = power * (j == order ? 1. - h * formula.beta0 * s : Complex(formula.alpha[order - 1 - j]));
  for (int p = order; p > 0; --p)
  {
    if (!(std::norm(a[0]) < std::norm(a[p])))
      return false;
    double largest = 0.;
    for (int j = 0; j < p; ++j)
    {
      b[j]    = std::conj(a[p]) * a[j + 1] - a[0] * std::conj(a[p - j - 1]);
      largest = std::max(largest, std::norm(b[j]));
    }
    const double scale = 1. / std::sqrt(largest);
    for (int j = 0; j < p; ++j)
      a[j] = scale * b[j];
  }
  return true;
}

BdfOrderLimit::BdfOrderLimit(std::vector<SpectrumLine> spectrum, int n_modes, double largest_step)
    : spectrum_(std::move(spectrum)), complete_(static_cast<int>(spectrum_.size()) >= n_modes),
      largest_step_(largest_step)
{
}

bool BdfOrderLimit::allows(int order, int rung)
{
  if (order <= 2)
    return true;
  if (!complete_)
    return false;
  Answer &answer = answers_[std::min(rung, n_rungs - 1)][order];
  if (answer == Answer::unknown)
  {
    const double h      = std::ldexp(largest_step_, -rung);
    const bool   decays = std::all_of(spectrum_.begin(), spectrum_.end(),
                                      [=](const SpectrumLine &mode) { return bdf_decays(order, mode, h); });
    answer              = decays ? Answer::yes : Answer::no;
  }
  return answer == Answer::yes;
}

} // namespace gestell::coupling
