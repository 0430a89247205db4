#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/test_oscillator.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Properties of a method's step for the test oscillator, from the roots r of its characteristic polynomial.
 *
 * The principal root r is the one closest to exp(mu), mu = (-zeta + i sqrt(1 - zeta^2)) omega h.  For omega h sqrt(1 -
 * zeta^2) >= pi, where no root can represent the motion, it is the largest one that vibrates.
 */
struct StepProperties
{
  double spectral_radius;   ///< largest |r| of all roots
  double log_growth;        ///< ln of it, accurate also if it is tiny
  double period_elongation; ///< omega h sqrt(1 - zeta^2) / arg r - 1; nan if r does not vibrate
  double numerical_damping; ///< -ln|r| / |ln r| - zeta; nan if r does not vibrate
};

/// @throws std::invalid_argument for omega_h <= 0 or zeta < 0
StepProperties step_properties(const MethodOptions &options, const TestOscillator &oscillator);
double         spectral_radius(const MethodOptions &options, const TestOscillator &oscillator);

/// Interval of omega h in which the method is unstable.
struct UnstableInterval
{
  double from, to;           ///< to may be infinite; from is 0 if it grows for arbitrarily small steps
  double growth, at_omega_h; ///< largest growth factor per step, and its omega h; for to = infinity up to omega h = 1e7
};

/// All intervals of omega h up to 1e7 in which a mode with the damping ratio zeta grows, ascending; their ends have a
/// relative accuracy of 1e-9.
std::vector<UnstableInterval> unstable_intervals(const MethodOptions &options, double zeta,
                                                 Spring spring = Spring::base);

} // namespace gestell::coupling
