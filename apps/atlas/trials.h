#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/machine/machine.h"

#include <vector>

namespace gestell::apps
{

/// A slider of `mass` on its own spring and damper to the ground, by omega [rad/s] and damping ratio; none for omega =
/// 0.
struct TrialMass
{
  double omega, zeta, mass = 1.;
};

/// Sliders "x0", "x1", ... that do not touch each other: a frame in its modes.
coupling::Machine trial_frame(const std::vector<TrialMass> &masses);

/// A free slider of 1 kg that an element holds with the stiffness omega^2: base system and contact of one.
coupling::Machine contact_oscillator(double omega);

/// x of every slider, one row a step, from x = 1 at rest, by the program's own integrator.
Eigen::MatrixXd step_through(coupling::Machine &machine, const coupling::MethodOptions &options, int n_steps);

/**
 * Growth per step of a sequence in which one root, or one conjugate pair, has outgrown the others: of
 *
 *     x_n = A r^n                     |r| = |x_n / x_m|^(1/(n-m))
 *     x_n = A |r|^n cos(n phi + psi)  D_n = x_n^2 - x_n+1 x_n-1 = A^2 sin^2(phi) |r|^2n,   |r| = (D_n /
 * D_m)^(1/(2n-2m))
 *
 * over its second half, whichever of the two is the steadier there.
 */
double measured_growth(const Eigen::VectorXd &x);

/// Steps after which a growth per step is well seen, and nothing overflows; at most 20000.
int steps_to_see(double growth);

} // namespace gestell::apps
