#pragma once

#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/// Tolerances of steps and of Newton's method below this are rounding.
constexpr double finest_tolerance = 1e-13;

// Scales in which Newton's corrections of the measures, scale [n_u], are judged: what rounding leaves of them for ever.
// Asked for only where corrections do not end.

/// Forces that balance each other leave rounding of what each would do alone.  A measure that others hold has no other
/// scale.
/// @param S     compliance over the step [n_u x n_u]
/// @param left  of the motion by one force: rounding in units of the tolerance
void allow_for_rounding(const Eigen::MatrixXd &S, const Eigen::VectorXd &p, double left, Eigen::VectorXd &scale);

/// Joints close positions to a rounding of their size, and a virtual coordinate follows by its law: bristles of 3e4 N
/// m/rad make 3e-12 N m of an angle known to 1e-16.
/// @param blocks, tangent  of the forces: p' as local_tangent_blocks() gives it
/// @param left             of the size of a joint: rounding in units of the tolerance
void allow_for_closing(const SecondOrderSystem &system, const Eigen::MatrixXd &S, const std::vector<ForceBlock> &blocks,
                       const Eigen::VectorXd &tangent, double left, Eigen::VectorXd &scale);

} // namespace gestell::coupling
