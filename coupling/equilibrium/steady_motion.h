#pragma once

#include "coupling/machine/configuration/assembly.h"

#include <vector>

namespace gestell::coupling
{

/**
 * A motion in which coordinates with given speed keep it, q_h' = const, and bodies follow without elastic deformation;
 * the frame is at rest (docs/theory/start.md (14)):
 *
 *     G W^T v = -rate,        v_h = given,       G W^T a = -bias,       a_h = 0,
 *     G W^T S = 0,            S_h = E.
 *
 * The remaining DOFs are determined in this order: compliant joints and chains of closed elements are closed, then
 * clearances, the smallest first; then elastic energy and finally motion is minimised.
 */
struct SteadyMotion
{
  Eigen::VectorXd  v, a;  ///< [n]
  Eigen::MatrixXd  S;     ///< [n x n_h] acceleration per unit acceleration of the coordinates with given speed
  std::vector<int> plays; ///< clearances that it closes, by the first measure of their element
};

/**
 * @param known  the given speeds: coordinates with v_given, rates, spins, in this order
 * @param q      satisfies the joints at known.state.t
 * @throws std::invalid_argument if joints make given speeds depend on each other
 */
SteadyMotion steady_motion(const Machine &machine, const KnownStart &known, const Eigen::VectorXd &q);

} // namespace gestell::coupling
