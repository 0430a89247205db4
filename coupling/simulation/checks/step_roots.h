#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/modes/linear_spectrum.h"

#include <optional>

namespace gestell::coupling
{

/// A growing motion in modal coordinates, and its growth per step.
struct GrowingMotion
{
  double          radius;
  Eigen::VectorXd direction; ///< y [p]
};

/**
 * The motion x r^k that grows fastest with a method that has step_weights(), for a machine with follower forces, where
 * definiteness does not decide (LinearMachine::C):
 *
 *     (mass(r) E + damping(r) h B + stiffness(r) h^2 C) x = 0,
 *
 * a matrix polynomial in r of second or third degree.  Physical growth exp(sigma t) is not an error of the method: the
 * result is empty if ln |r| <= 2 sigma h, at most twice the physical growth rate.
 *
 * Source: docs/theory/stability.md, Forces that follow the motion.
 */
std::optional<GrowingMotion> growing_step(const LinearMachine &machine, const MethodOptions &options, double h);

} // namespace gestell::coupling
