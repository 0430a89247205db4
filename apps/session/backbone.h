#pragma once

#include "apps/output/values/periodic_result.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_problem.h"

#include <vector>

namespace gestell::apps
{

/**
 * The backbone of the mode nearest to the load, from small amplitudes to those of the solutions: free motions
 *
 *     q = mean + phi a cos(omega(a) t),     omega^2 = omega_0^2 + k(a)
 *
 * with their signals, each with the parameter at which the load has this frequency; phi, omega_0, k(a) as in SlowFlow.
 *
 * Empty where the parameter is not the load's frequency, the machine has more than a few coordinates, or averaging
 * does not serve.
 */
std::vector<PeriodicEntry> backbone_of(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                       const std::vector<PeriodicEntry>    &entries,
                                       const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
