#pragma once

#include "coupling/equilibrium/steady_motion.h"

namespace gestell::coupling
{

/**
 * Seating of plays that a motion closes but that are open at a state: on the side loaded by weight and inertia,
 * docs/theory/start.md (16). A play without force stays centred; one in tension is left to its law.
 *
 * The position closes joints and keeps what is held; it is where the search for the equilibrium (15) begins.
 *
 * @param held    what is kept where it is, as for held_equilibrium()
 * @param motion  of the machine
 * @return q [n]; that of the state where no play is open, or where no such position is found
 */
Eigen::VectorXd seated_plays(Machine &machine, const KnownStart &held, const SteadyMotion &motion,
                             const InitialState &state);

} // namespace gestell::coupling
