#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <array>
#include <vector>

namespace gestell::coupling
{

/**
 * Which orders of BDF may be used with the step h_max / 2^rung: those for which no mode of the base system grows.
 *
 * Orders 1 and 2 always; an order from 3 to 6 if the formula's roots for every mode lie in the unit circle.  Looked at
 * when asked for the first time, then remembered.  Beyond order 2 every mode has to be known: a spectrum that lists
 * fewer modes than there are coordinates with mass allows nothing above 2.
 */
class BdfOrderLimit
{
public:
  /// @param n_modes  that there are
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

/// True if all roots r of BDF of the given order for y' = s y lie in |r| <= 1 + 1e-9, for
/// s = -zeta omega + i omega sqrt(1 - zeta^2); by the recursion of Schur and Cohn, without computing roots.
bool bdf_decays(int order, const SpectrumLine &mode, double h);

} // namespace gestell::coupling
