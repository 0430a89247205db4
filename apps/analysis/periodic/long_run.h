#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/periodic_request.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_method.h"

#include <vector>

namespace gestell::apps
{

/// Checks that enough periods are requested, for a single machine.  @throws std::invalid_argument
void check_long_run(const PeriodicRequest &request);

/**
 * Verifies solutions classified as stable by a run, except those of a branch.
 *
 * Then classifies the long-term motion from `start` over a few hundred periods, if no stable solution was found or the
 * request asks for it.
 *
 * If this motion is periodic, also with several excitation periods, the solution is computed and added to `solutions`.
 * A failure of the search is cleared if the motion is recognised.
 */
void follow_long_run(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                     const coupling::PeriodicGuess &start, const coupling::PeriodicOptions &options,
                     const PeriodicRequest &request, const std::vector<coupling::Signal> &signals,
                     std::vector<coupling::PeriodicSolution> &solutions, PeriodicResult &found);

} // namespace gestell::apps
