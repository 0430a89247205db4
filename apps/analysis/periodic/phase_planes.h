#pragma once

#include "apps/output/values/periodic_result.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_problem.h"

#include <optional>
#include <vector>

namespace gestell::apps
{

/// The rate of a signal, if it follows exactly from q and q': for displacements, angles and measures.
std::optional<coupling::Signal> rate_of(const coupling::Signal &signal);

/// The first solutions in the plane of each signal whose rate is known exactly; only a few solutions.
/// @throws coupling::ConvergenceFailure if a solution cannot be integrated
std::vector<PhasePlane> phase_planes(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                     const std::vector<PeriodicEntry>    &entries,
                                     const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
