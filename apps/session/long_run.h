#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/periodic_request.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_method.h"

#include <vector>

namespace gestell::apps
{

/// That enough periods are asked for, of one machine.  @throws std::invalid_argument
void check_long_run(const PeriodicRequest &request);

/**
 * Verifies the motions that are called stable by a run, unless they are those of a branch.
 *
 * Follows the motion that begins at `start` for some hundred periods where nothing that lasts was found, or where the
 * request asks for it, and tells what it is.
 *
 * A motion that repeats, after several periods too, is then computed, into `solutions`.  What is recognised is no
 * failure any more.
 */
void follow_long_run(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                     const coupling::PeriodicGuess &start, const coupling::PeriodicOptions &options,
                     const PeriodicRequest &request, const std::vector<coupling::Signal> &signals,
                     std::vector<coupling::PeriodicSolution> &solutions, PeriodicResult &found);

} // namespace gestell::apps
