#pragma once

#include "apps/analysis/periodic/scene_family.h"
#include "apps/output/values/periodic_result.h"

#include <functional>

namespace gestell::apps
{

/**
 * Continues the branches that start at the solutions (follow_branch()), and the period-doubled branches that bifurcate
 * from them.  All points, numbered by branch, and special points are added to `result`.
 *
 * @param progress  completed share of the range
 * @param stop      ends the current branch; its points so far are retained
 */
void follow_branches(const SceneFamily &family, const std::vector<coupling::PeriodicSolution> &solutions,
                     const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                     const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                     PeriodicResult &result);

} // namespace gestell::apps
