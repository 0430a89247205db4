#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/modes/linear_spectrum.h"

#include <optional>

namespace gestell::coupling
{

/// A direction of motion in the modes that grows, and by how much in every step.
struct GrowingMotion
{
  double          radius;
  Eigen::VectorXd direction; ///< y [p]
};

/**
 * The motion x r^k that grows fastest under a method with step_weights(), over a machine of forces that follow the
 * motion, where no definiteness decides (LinearMachine::C):
 *
 *     (mass(r) E + damping(r) h B + stiffness(r) h^2 C) x = 0,
 *
 * a matrix polynomial in r of second or third degree.  What grows by itself, exp(sigma t), is no fault of the method:
 * nothing where ln |r| is at most 2 sigma h, a growth that the step has no more than doubled.
 *
 * Source: docs/stability.md, Forces that follow the motion.
 */
std::optional<GrowingMotion> growing_step(const LinearMachine &machine, const MethodOptions &options, double h);

} // namespace gestell::coupling
