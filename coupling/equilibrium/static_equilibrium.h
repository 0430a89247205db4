#pragma once

#include "coupling/equilibrium/steady_motion.h"
#include "coupling/machine/configuration/assembly.h"

namespace gestell::coupling
{

enum class Drift
{
  none,       ///< at rest
  quasistatic ///< with the velocity at which the equilibrium moves along with prescribed motions
};

/// Treatment of loads on rigid-body modes of an unsupported machine, such as a satellite.
enum class Floating
{
  refused, ///< there is no equilibrium, unless no force acts along them
  relieved ///< the inertia of the machine balances them
};

/**
 * Static equilibrium near an assembled position:
 *
 *     C q = f_t + W p(q, 0),     p = G^T lambda of joints,     g(t, q) = 0,
 *
 * by Newton's method with the whole tangent (geometric stiffness included); where it fails, constant loads are applied
 * in steps. Laws that depend on u' act as at rest; sticking elements carry no force.  The velocity of the drift follows
 * from the equilibrium's derivative, K q' = W G^T lambda',  G W^T q' = -dg/dt.
 *
 * With inertia relief a floating machine has the deflection of its accelerated motion, with the rigid-body modes R, R^T
 * M R = E:
 *
 *     C q = (1 - M R R^T)(f_t + W p),     R^T M (q - q_assembled) = 0,     acceleration R R^T (f_t + W p),
 *
 * so that a run starts without vibration; a note gives the acceleration.
 *
 * @throws std::invalid_argument if a motion has neither stiffness nor weight, or no equilibrium is found
 */
InitialState static_equilibrium(Machine &machine, const InitialState &assembled, Drift drift,
                                Floating floating = Floating::refused);

struct HeldEquilibrium
{
  Eigen::VectorXd q;      ///< [n]
  Eigen::VectorXd lambda; ///< [n_c] multipliers of the joints
};

/**
 * The same with fixed coordinates: given coordinates of bodies and measures keep their values, driven joints are at
 * `position.shifts`; constraint forces are arbitrary.  Of loads that vary with time the constant part acts;
 * technological forces and drives are off (Acting::structure), since the machine is at rest. A motion without stiffness
 * along which no force acts remains unchanged.
 *
 * For a machine in motion all forces act, fixed coordinates have an unknown acceleration instead of a constraint force,
 * and inertia and damping forces of the motion are added to the loads, docs/theory/start.md (15).
 *
 * @param position  assembled, with chains that clearances open just touching
 * @param motion    of a machine in motion, or null
 * @param from      start of the search; null: `position`
 * @throws std::invalid_argument as static_equilibrium() does
 */
HeldEquilibrium held_equilibrium(Machine &machine, const KnownStart &position, const SteadyMotion *motion = nullptr,
                                 const InitialState *from = nullptr);

} // namespace gestell::coupling
