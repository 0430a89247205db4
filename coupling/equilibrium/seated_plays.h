#pragma once

#include "coupling/equilibrium/steady_motion.h"

namespace gestell::coupling
{

/**
 * Seating of clearances that a motion closes but that are open at a state: on the side loaded by weight and inertia,
 * docs/theory/start.md (16).  A clearance without force remains centred; for one in tension the law decides.
 *
 * The position satisfies the joints and keeps the fixed coordinates; the equilibrium search (15) starts there.
 *
 * @param held    fixed coordinates, as for held_equilibrium()
 * @param motion  of the machine
 * @return q [n]; that of the state if no clearance is open, or if no such position is found
 */
Eigen::VectorXd seated_plays(Machine &machine, const KnownStart &held, const SteadyMotion &motion,
                             const InitialState &state);

} // namespace gestell::coupling
