#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/periodic_request.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/periodic_method.h"

#include <functional>
#include <vector>

namespace gestell::apps
{

/**
 * The plane of initial states given by `--basins`: "X, Y" are coordinates as in [start], or their rates with ', each
 * with an optional "from A to B"; the default is twice the largest excursion of the solutions found.
 *
 * @throws std::invalid_argument with the wrong part of the text
 */
coupling::StartPlane start_plane(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                 const std::vector<coupling::PeriodicSolution> &solutions,
                                 const PeriodicRequest                         &request);

/// Checks the text of --basins against the machine before anything is computed.
/// @throws std::invalid_argument
void check_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                  const PeriodicRequest &request);

/// Adds the basins of the solutions in this plane, or a note why there are none.
void find_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                 const coupling::PeriodicGuess &start, const std::vector<coupling::PeriodicSolution> &solutions,
                 const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                 const std::function<void(double)> &progress, PeriodicResult &found);

} // namespace gestell::apps
