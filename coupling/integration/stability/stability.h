#pragma once

#include "coupling/integration/stability/oscillator_step.h"

#include <Eigen/Core>

#include <limits>
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

/**
 * Weights of a motion x r^k in the balance of a one-step method that averages no forces: Newmark, central differences,
 * Wilson.  Accelerations x, and with them velocities and displacements, fulfil
 *
 *     (mass(r) M + damping(r) h B + stiffness(r) h^2 C) x = 0.
 *
 * Their sign is chosen so that all are positive for large negative r.
 * @throws std::invalid_argument for other methods
 */
struct StepWeights
{
  double mass, damping, stiffness;
};
StepWeights step_weights(const MethodOptions &options, double r);

/// Whether step_weights() knows the method.
bool has_step_weights(const MethodOptions &options);

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

/// Damping ratio from which on no mode grows at any step, BDF: 0, 0, 0.0692, 0.286, 0.618, 0.952 for orders 1 to 6.
double sufficient_damping(int bdf_order);

} // namespace gestell::coupling
