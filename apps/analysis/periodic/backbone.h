#pragma once

#include "apps/output/values/periodic_result.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_problem.h"

#include <vector>

namespace gestell::apps
{

/**
 * The backbone of the mode nearest to the load frequency: free vibrations with amplitudes from small values to those of
 * the solutions,
 *
 *     q = mean + phi a cos(omega(a) t),     omega^2 = omega_0^2 + k(a)
 *
 * with their signals, each with the parameter value at which the load has the frequency omega(a); phi, omega_0, k(a) as
 * in SlowFlow.
 *
 * Empty if the parameter is not the load's frequency, the machine has more than a few coordinates, or averaging is not
 * applicable.
 */
std::vector<PeriodicEntry> backbone_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                       const std::vector<PeriodicEntry>    &entries,
                                       const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
