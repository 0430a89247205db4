#pragma once

#include "coupling/periodic/shift_invariance.h"

namespace gestell::coupling
{

/// Increments of angles in a period after which the equations repeat.
struct AngleIncrements
{
  Eigen::VectorXd turn;        ///< [n] [rad]; along `free` that of the speeds
  Eigen::MatrixXd free;        ///< [n x k] orthonormal: increments that the motion itself chooses
  double          period = 0.; ///< [s] by the speeds, where it was not given
  int phase = -1;      ///< coordinate that completes revolutions, where the period was not given; -1: nothing rotates
  std::string refusal; ///< not empty: there are none, and why
};

/**
 * Increments of angles that turn with these speeds, in a period that is given or, if it is zero, in the shortest one
 * after which they may repeat: up to 64 turns of the slowest.
 *
 * @param speeds     [n] [rad/s]
 * @param tolerance  of speeds, relative: within it whole turns are meant
 */
AngleIncrements increments_of(const AngleInvariance &invariance, const Eigen::VectorXd &speeds, double period,
                              double tolerance, const LinearSystem &names);

} // namespace gestell::coupling
