#pragma once

#include "coupling/integration/second_order_system.h"

#include <optional>
#include <vector>

namespace gestell::coupling
{

/// Spectral radius of BDF of the given order for the mode s = -zeta omega + i omega sqrt(1 - zeta^2), step h: largest
/// |r| with
///
///     r^p (1 - h beta0 s) + sum_{i=1..p} alpha_i r^(p-i) = 0          (5.5.2/6 with y' = s y).
double bdf_spectral_radius(int order, const SpectrumLine &mode, double h);

/// A mode whose amplitude grows by `growth` > 1 in every step.
struct UnstableMode
{
  SpectrumLine mode;
  double       growth;
};

/// The fastest growing mode of a spectrum, if any grows.  Orders 1 and 2 are stable for every damped mode.
std::optional<UnstableMode> unstable_mode(int order, const std::vector<SpectrumLine> &spectrum, double h);

} // namespace gestell::coupling
