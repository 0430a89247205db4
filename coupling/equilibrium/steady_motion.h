#pragma once

#include "coupling/machine/assembly.h"

namespace gestell::coupling
{

/**
 * A motion in which what has a given speed goes on with it, q_h' = const, and bodies follow without elastic
 * deformation; the frame rests (docs/theory/start.md (14)):
 *
 *     G W^T v = -rate,        v_h = given,       G W^T a = -bias,       a_h = 0,
 *     G W^T S = 0,            S_h = E.
 *
 * What that leaves open closes compliant joints and chains of closed elements, then costs least elastic energy, then
 * moves least.
 */
struct SteadyMotion
{
  Eigen::VectorXd v, a; ///< [n]
  Eigen::MatrixXd S;    ///< [n x n_h] acceleration per unit acceleration of what has a given speed
};

/**
 * @param known  what goes on: coordinates with v_given, rates, spins, in this order
 * @param q      closes the joints at known.state.t
 * @throws std::invalid_argument if joints make given speeds depend on each other
 */
SteadyMotion steady_motion(const Machine &machine, const KnownStart &known, const Eigen::VectorXd &q);

/**
 * The jointed counterpart of steady_start(): the state from which the machine runs on quietly, joints closed in
 * position and rate, everything elastic in equilibrium with the forces of the instant and with the inertia of its
 * motion (docs/theory/start.md (15)),
 *
 *     M (a + S alpha) + B v + C q = f_t + W p(t, q, v, a + S alpha),     g(t, q) = 0.
 *
 * alpha [n_h] accelerates what has a given speed: what the drives give too much or too little.
 *
 * @param known  as for assemble(); what has a given speed keeps its position, other positions are first guesses
 * @throws std::invalid_argument without a given speed, or as assemble(), steady_motion() and static_equilibrium()
 */
InitialState steady_start(Machine &machine, const KnownStart &known);

} // namespace gestell::coupling
