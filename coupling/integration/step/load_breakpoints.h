#pragma once

#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/// Motion predicted from future loads: sqrt(x^T M x) of displacement and velocity.
struct LoadedMotion
{
  double way = 0., speed = 0.; ///< [sqrt(kg) m], [sqrt(kg) m/s]
};

/**
 * Predicts the size of the motion caused by the loads of a run, even if they act late: loads f_t and the forces of laws
 * for the initial motion, evaluated at instants tau apart.  Their change df since the start moves the base system in
 * the time tau by
 *
 *     (M + tau B + tau^2 C) x = tau^2 df,      x' = x / tau,
 *
 * one implicit Euler step from rest: C^-1 df if the system is stiff, tau^2 M^-1 df if it is free.  The instant with the
 * largest sum of loads is used.  Zero if no load changes.
 *
 * @param at   start, with its measures; laws must follow the motion, not their history
 * @param end  of the run [s]
 */
LoadedMotion load_breakpoints(const SecondOrderSystem &system, const LocalState &at, double end);

} // namespace gestell::coupling
