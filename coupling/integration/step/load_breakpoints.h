#pragma once

#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/// The motion that loads to come would bring: sqrt(x^T M x) of it and of its velocity.
struct LoadedMotion
{
  double way = 0., speed = 0.; ///< [sqrt(kg) m], [sqrt(kg) m/s]
};

/**
 * The size of the motion that the loads of a run bring, whenever they begin: loads f_t and the forces that laws give at
 * the motion of the begin, looked at in instants tau apart.  What changes since the begin, df, moves the base system in
 * the time tau by
 *
 *     (M + tau B + tau^2 C) x = tau^2 df,      x' = x / tau,
 *
 * one implicit Euler step from rest: C^-1 df where the system is stiff, tau^2 M^-1 df where it is free.  Of all
 * instants that counts in which the loads are largest together.  Zero where no load changes.
 *
 * @param at   begin, with its measures; laws must follow the motion, not their history
 * @param end  of the run [s]
 */
LoadedMotion load_breakpoints(const SecondOrderSystem &system, const LocalState &at, double end);

} // namespace gestell::coupling
