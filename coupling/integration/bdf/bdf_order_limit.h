#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <array>
#include <vector>

namespace gestell::coupling
{

/**
 * Allowed orders of BDF for the step h_max / 2^rung: those for which no mode of the base system grows.
 *
 * Orders 1 and 2 are always allowed; an order from 3 to 6 is allowed if the roots of the formula for every mode are
 * inside the unit circle.  The answer is computed at the first request and cached.  Orders above 2 require that every
 * mode is known: with a spectrum of fewer modes than coordinates with mass they are not allowed.
 */
class BdfOrderLimit
{
public:
  /// @param n_modes  total number of modes
  BdfOrderLimit(std::vector<SpectrumLine> spectrum, int n_modes, double largest_step);

  bool allows(int order, int rung);

private:
  static constexpr int n_rungs = 64;
  enum class Answer : char
  {
    unknown,
    yes,
    no
  };

  std::vector<SpectrumLine>                  spectrum_;
  bool                                       complete_;
  double                                     largest_step_;
  std::array<std::array<Answer, 7>, n_rungs> answers_{};
};

/// True if all roots r of BDF of the given order for y' = s y lie in |r| <= 1 + 1e-9, for s = -zeta omega + i omega
/// sqrt(1 - zeta^2); by the Schur-Cohn recursion, without computing roots.
bool bdf_decays(int order, const SpectrumLine &mode, double h);

} // namespace gestell::coupling
