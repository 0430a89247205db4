#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/integration/system/linear_system.h"

#include <Eigen/Core>

namespace gestell::coupling
{

class StateArchive;

/**
 * Checks whether forces of the base system are dominated by rounding errors.  Because of large stiffnesses the force of
 * a coordinate has the rounding error
 *
 *     r_i = epsilon sum_j |C_ij| max|q_j|
 *
 * so that the lost forces of weaker springs and of inertia do the work sum_i r_i (max q_i - min q_i) along the motion.
 * The energy balance does not show this, because its own rounding bound grows with the same forces.
 *
 * Source: docs/theory/integration.md (11b).
 */
class RoundingGuard
{
public:
  /// Called once per step.
  void step(const Eigen::VectorXd &q);

  /// Adds a warning unless the rounding error is small: its work is below one per cent of the energy exchanged by the
  /// motion, or below a millionth of the initial energy.  No check for systems without dense matrices.
  /// @param exchanged,  at_begin  [J]
  void finish(const LinearSystem &system, double exchanged, double at_begin, RunOutcome &outcome) const;

  void exchange(StateArchive &archive);

private:
  Eigen::VectorXd least_, most_; ///< q [n]
};

} // namespace gestell::coupling
