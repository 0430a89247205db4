#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/machine/machine.h"

#include <vector>

namespace gestell::apps
{

/// A slider of `mass` with its own spring and damper to the ground, by omega [rad/s] and damping ratio; none for omega
/// = 0.
struct TrialMass
{
  double omega, zeta, mass = 1.;
};

/// Independent sliders "x0", "x1", ...: a frame in its modes.
coupling::Machine trial_frame(const std::vector<TrialMass> &masses);

/// A free slider of 1 kg with an element of stiffness omega^2 to the ground: base system and contact in one.
coupling::Machine contact_oscillator(double omega);

/// x of every slider, one row per step, from x = 1 at rest, by the program's own integrator.
Eigen::MatrixXd step_through(coupling::Machine &machine, const coupling::MethodOptions &options, int n_steps);

/**
 * Growth per step of a sequence that is dominated by one root, or one conjugate pair:
 *
 *     x_n = A r^n                     |r| = |x_n / x_m|^(1/(n-m))
 *     x_n = A |r|^n cos(n phi + psi)  D_n = x_n^2 - x_n+1 x_n-1 = A^2 sin^2(phi) |r|^2n,   |r| = (D_n /
 * D_m)^(1/(2n-2m))
 *
 * evaluated over its second half, with the formula that is steadier there.
 */
double measured_growth(const Eigen::VectorXd &x);

/// Number of steps after which a growth per step is clearly visible, without overflow; at most 20000.
int steps_to_see(double growth);

} // namespace gestell::apps
