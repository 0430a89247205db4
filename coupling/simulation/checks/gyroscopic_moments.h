#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/**
 * Warns of rotors whose gyroscopic moments, which the model neglects, are significant.
 *
 * A rotor of inertia J and speed Omega whose axis tilts at the rates a', b' about two directions normal to it requires
 * the moments J Omega b', -J Omega a'.  The machine neglects them; at the rotor's own frequency they couple the two
 * tilts by
 *
 *     kappa = J Omega^2 sqrt(f_a f_b),     f = w^T (C + Omega^2 M)^-1 w,
 *
 * with the flexibilities f of its carrier against a moment about the directions w.
 *
 * @param v        velocities [n], with the speed of each rotor
 * @param outcome  receives a warning for every rotor with kappa above 0.02; none for an unreduced frame, which is too
 *                 large to be factorized
 */
void check_tilting_rotors(const Machine &machine, const Eigen::VectorXd &v, RunOutcome &outcome);

} // namespace gestell::coupling
