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
 * The plane of starts that `--basins` asks for: "X, Y", coordinates as [start] names them, with ' their rates, each
 * with "from A to B" if wanted; else over twice the largest excursions of the motions found.
 *
 * @throws std::invalid_argument with the part that is wrong
 */
coupling::StartPlane start_plane(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                 const std::vector<coupling::PeriodicSolution> &solutions,
                                 const PeriodicRequest                         &request);

/// What the text of --basins says wrong about the machine, before anything is computed.
/// @throws std::invalid_argument
void check_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                  const PeriodicRequest &request);

/// The basins of the solutions in it, or a note why there are none.
void find_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                 const coupling::PeriodicGuess &start, const std::vector<coupling::PeriodicSolution> &solutions,
                 const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                 const std::function<void(double)> &progress, PeriodicResult &found);

} // namespace gestell::apps
