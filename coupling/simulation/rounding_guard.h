#pragma once

#include "coupling/integration/events/finding.h"
#include "coupling/integration/system/linear_system.h"

#include <Eigen/Core>

namespace gestell::coupling
{

class StateArchive;

/**
 * Says whether forces of the base system are rounding: beside the stiffness of a coordinate its force is known to
 *
 *     r_i = epsilon sum_j |C_ij| max|q_j|
 *
 * and what is lost of weaker springs and of inertia does the work sum_i r_i (max q_i - min q_i) along the motion.  The
 * balance of energy cannot tell: its own bound of rounding grows with the same forces.
 *
 * Source: docs/theory/integration.md (11b).
 */
class RoundingGuard
{
public:
  /// Once per step.
  void step(const Eigen::VectorXd &q);

  /// Warns unless rounding is little: work below one per cent of the energy that the motion exchanges, or below a
  /// millionth of what it began with.  Nothing of systems that have no dense matrices.
  /// @param exchanged, at_begin  [J]
  void finish(const LinearSystem &system, double exchanged, double at_begin, RunOutcome &outcome) const;

  void exchange(StateArchive &archive);

private:
  Eigen::VectorXd least_, most_; ///< q [n]
};

} // namespace gestell::coupling
