#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/test_oscillator.h"

#include <Eigen/Core>

namespace gestell::coupling
{

using LongMatrix2 = Eigen::Matrix<long double, 2, 2>;

/// The parameters of Newmark's family:
///
///     M ((1-alpha_m) a_1 + alpha_m a_0) + (1-alpha_f) (B v + C q)_1 + alpha_f (B v + C q)_0 = f,
///     v_1 = v_0 + h ((1-gamma) a_0 + gamma a_1),    q_1 = q_0 + h v_0 + h^2 ((1/2-beta) a_0 + beta a_1).
struct NewmarkFamily
{
  double alpha_m, alpha_f, beta, gamma;
};

/// Newmark itself, central differences (beta = 0, gamma = 1/2), HHT (alpha_f = -alpha, Hilber, Hughes and Taylor 1977),
/// generalised alpha (Chung and Hulbert 1993); and the contact oscillator under exact propagation with a mean
/// (beta = 1/4) or a linear force (beta = 1/6), gamma = 1/2.
NewmarkFamily newmark_family(const MethodOptions &options);

/// Step (x, h x') of a free mass with the spring and damper of an element under exact propagation, where the element's
/// force is the polynomial through its values at Gauss points c_i:
///
///     p_i = -(Omega^2 u_i + 2 zeta Omega h u'_i),   u_i = u_0 + c_i h u'_0 + sum_j p_j int_0^c_i (c_i - s) L_j(s) ds.
LongMatrix2 contact_step(const MethodOptions &options, const TestOscillator &oscillator);

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

} // namespace gestell::coupling
