#pragma once

#include "coupling/integration/method.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace gestell::coupling
{

/// Whose spring makes the test oscillator vibrate.  It matters for exact propagation only, which carries the base
/// system exactly and interpolates the forces of elements.
enum class Spring
{
  base,   ///< of the linear base system
  contact ///< of an element that is closed: the base system is a free mass
};

/// A method with a fixed step on the test oscillator  x'' + 2 zeta omega x' + omega^2 x = 0.
struct TestOscillator
{
  double zeta;    ///< >= 0
  double omega_h; ///< > 0
  Spring spring = Spring::base;
};

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
 * The step as a matrix on the state that the method carries, lengths in units of x, times in units of h:
 *
 *     BDF of order p                   (x_k, ..., x_k-p+1, h x'_k, ..., h x'_k-p+1)        [2p x 2p]
 *     Newmark, HHT, generalised alpha,
 *     Wilson, central differences      (x, h x', h^2 x'')                                  [3 x 3]
 *     exact propagation                (x, h x')                                           [2 x 2]
 *
 * Central differences with the central velocity are Newmark's formulas with beta = 0, gamma = 1/2.
 */
Eigen::MatrixXd amplification_matrix(const MethodOptions &options, const TestOscillator &oscillator);

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

/// Largest |x| / x_0 or, for a start with velocity, |x| omega / v_0, and largest |x'| / omega likewise.
struct Overshoot
{
  double displacement, velocity;
  int    displacement_step, velocity_step; ///< where they occur
};

enum class OscillatorStart
{
  displaced, ///< x = 1, x' = 0
  moving     ///< x = 0, x' = omega
};

/// The first steps of BDF.
enum class BdfStart
{
  extrapolated, ///< chains of implicit Euler steps, as the integrator begins
  order_ramp    ///< orders 1, 2, ... p, as tables of the literature have it
};

/// In the first 20 steps, from consistent accelerations.
Overshoot overshoot(const MethodOptions &options, const TestOscillator &oscillator, OscillatorStart start,
                    BdfStart first_steps = BdfStart::extrapolated);

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
