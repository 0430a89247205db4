#pragma once

#include "coupling/periodic/periodic_method.h"
#include "coupling/periodic/slow_motions.h"

namespace gestell::coupling
{

/// "shooting": Newton on the motion over one period (5.5.4/1), after some periods of lead-in.
const PeriodicMethod &shooting_method();

/**
 * Newton's method with SlowMotions, at first with coarse steps; its matrix is kept while the motion closes well.  Where
 * it does not, more motions are slow; where all are, this is shoot().  Multipliers are those above the share of what is
 * fast, by Rayleigh and Ritz from the images of their motions, and how well these are kept is told.
 *
 * @throws NoPeriodicMotion, ConvergenceFailure as shoot()
 */
PeriodicSolution shoot_slow(const PeriodicProblem &problem, SlowMotions &slow, const PeriodicGuess &guess,
                            const PeriodicOptions &options);

} // namespace gestell::coupling
