#pragma once

#include "coupling/steady_start.h"

namespace gestell::coupling
{

enum class Drift
{
  none,       ///< at rest
  quasistatic ///< with the velocity at which the equilibrium moves along with prescribed motions
};

/**
 * Static equilibrium near an assembled position:
 *
 *     C q = f_t + W p(q, 0),     p = G^T lambda of joints,     g(t, q) = 0,
 *
 * by Newton's method with the whole tangent (geometric stiffness included); where it fails, constant loads are put on
 * in parts.  Laws that depend on u' act as at rest; what sticks carries no force.  The velocity of the drift follows
 * from the equilibrium's derivative, K q' = W G^T lambda',  G W^T q' = -dg/dt.
 *
 * @throws std::invalid_argument if a motion has neither stiffness nor weight to hold it, or no equilibrium is found
 */
InitialState static_equilibrium(Machine &machine, const InitialState &assembled, Drift drift);

} // namespace gestell::coupling
