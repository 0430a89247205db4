#pragma once

#include "coupling/integration/step/compliance.h"
#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/// Tolerances of steps and of Newton's method below this are dominated by rounding.
constexpr double finest_tolerance = 1e-13;

// Lower bounds of the scales [n_u] for Newton's corrections of the measures, from rounding errors that never vanish.
// Used only if corrections do not converge.

/// Forces that balance each other leave the rounding error of their separate effects.  A measure that others constrain
/// has no other scale.
/// @param left  rounding, relative to the motion by one force, in units of the tolerance
void allow_for_rounding(const Compliance &S, const Eigen::VectorXd &p, double left, Eigen::VectorXd &scale);

/// Joints are satisfied up to a rounding error of their size, and a virtual coordinate amplifies it by its law:
/// bristles of 3e4 N m/rad turn an angle error of 1e-16 into 3e-12 N m.
/// @param blocks,  tangent  of the forces: p' as local_tangent_blocks() gives it
/// @param left     rounding, relative to the size of a joint, in units of the tolerance
void allow_for_closing(const SecondOrderSystem &system, const Compliance &S, const std::vector<ForceBlock> &blocks,
                       const Eigen::VectorXd &tangent, double left, Eigen::VectorXd &scale);

} // namespace gestell::coupling
