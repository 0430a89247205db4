#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/**
 * Rotors whose missing gyroscopic moments would matter.
 *
 * A rotor of inertia J that turns at Omega while its axis tilts at the rates a', b' about two directions across it
 * takes the moments  J Omega b', -J Omega a'.  The machine leaves them out; at the rotor's own frequency they couple
 * the two tilts by
 *
 *     kappa = J Omega^2 sqrt(f_a f_b),     f = w^T (C + Omega^2 M)^-1 w,
 *
 * with the flexibilities f of its carrier against a moment about the directions w.
 *
 * @param v  velocities [n] of which each rotor's speed is taken
 * @param outcome  gets a warning of every rotor whose kappa is above 0.02; of none on an unreduced frame, which is too
 *                 large to be factorized
 */
void check_tilting_rotors(const Machine &machine, const Eigen::VectorXd &v, RunOutcome &outcome);

} // namespace gestell::coupling
