#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/test_oscillator.h"

#include <vector>

namespace gestell::coupling
{

/**
 * How a method steps the test oscillator, from the roots r of its characteristic polynomial.
 *
 * The principal root r is the one closest to exp(mu), mu = (-zeta + i sqrt(1 - zeta^2)) omega h, and from
 * omega h sqrt(1 - zeta^2) = pi on, where no root can follow the motion any more, the largest one that vibrates.
 */
struct StepProperties
{
  double spectral_radius;   ///< of all roots, in every step
  double log_growth;        ///< ln of it, exact also where it is tiny
  double period_elongation; ///< omega h sqrt(1 - zeta^2) / arg r - 1; nan where r does not vibrate
  double numerical_damping; ///< -ln|r| / |ln r| - zeta; nan where r does not vibrate
};

/// @throws std::invalid_argument for omega_h <= 0 or zeta < 0
StepProperties step_properties(const MethodOptions &options, const TestOscillator &oscillator);
double         spectral_radius(const MethodOptions &options, const TestOscillator &oscillator);

/// omega h in (from, to), where the method grows.
struct UnstableInterval
{
  double from, to;           ///< to may be infinite; from is 0 if it grows however small the step
  double growth, at_omega_h; ///< largest factor per step, and where; for to = infinity up to omega h = 1e7
};

/// All intervals of omega h up to 1e7 in which a mode with the damping ratio zeta grows, ascending; their ends are
/// exact to 1e-9 relative.
std::vector<UnstableInterval> unstable_intervals(const MethodOptions &options, double zeta,
                                                 Spring spring = Spring::base);

} // namespace gestell::coupling
