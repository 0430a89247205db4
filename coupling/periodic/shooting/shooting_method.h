#pragma once

#include "coupling/periodic/periodic_method.h"
#include "coupling/periodic/shooting/dominant_subspace.h"

namespace gestell::coupling
{

/// "shooting": Newton on the motion over one period (5.5.4/1), after some periods of lead-in.
const PeriodicMethod &shooting_method();

/**
 * Newton's method with DominantSubspace, at first with coarse steps; its matrix is reused while convergence is good.
 * Otherwise more motions are treated as slow; if all are, this is shoot().  The largest multipliers are found by
 * Rayleigh and Ritz; a note gives their number, and their residual where it has not converged.
 *
 * @throws NoPeriodicMotion, ConvergenceFailure as shoot()
 */
PeriodicSolution shoot_slow(const PeriodicProblem &problem, DominantSubspace &slow, PeriodicGuess guess,
                            const PeriodicOptions &options);

} // namespace gestell::coupling
