#pragma once

#include "coupling/machine/configuration/assembly.h"

#include <vector>

namespace gestell::coupling
{

/**
 * A motion in which what has a given speed goes on with it, q_h' = const, and bodies follow without elastic
 * deformation; the frame rests (docs/theory/start.md (14)):
 *
 *     G W^T v = -rate,        v_h = given,       G W^T a = -bias,       a_h = 0,
 *     G W^T S = 0,            S_h = E.
 *
 * Remaining freedom closes compliant joints and chains of closed elements, then plays, the smallest first, then
 * minimises elastic energy, then motion.
 */
struct SteadyMotion
{
  Eigen::VectorXd  v, a;  ///< [n]
  Eigen::MatrixXd  S;     ///< [n x n_h] acceleration per unit acceleration of what has a given speed
  std::vector<int> plays; ///< that it closes, by the first measure of their element
};

/**
 * @param known  what goes on: coordinates with v_given, rates, spins, in this order
 * @param q      closes the joints at known.state.t
 * @throws std::invalid_argument if joints make given speeds depend on each other
 */
SteadyMotion steady_motion(const Machine &machine, const KnownStart &known, const Eigen::VectorXd &q);

} // namespace gestell::coupling
