#pragma once

#include "coupling/periodic/periodic_solution.h"

#include <functional>

namespace gestell::coupling
{

/// Passes through one period of a solution: calls `look` at `samples` + 1 instants, equally spaced, both ends included.
/// @throws ConvergenceFailure where a motion that is integrated cannot be
void trace(const PeriodicProblem &problem, const PeriodicSolution &solution, int samples,
           const std::function<void(const OrbitPoint &)> &look);

/// After how many periods of the excitation a motion repeats already: a divisor of `solution.ratio`.
int own_ratio(const PeriodicProblem &problem, const PeriodicSolution &solution);

} // namespace gestell::coupling
