#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/scene_family.h"

#include <functional>

namespace gestell::apps
{

/**
 * Follows the branches that the solutions begin (follow_branch()), and those of doubled period that they shed; all
 * points, numbered by branches, and special points into `result`.
 *
 * @param progress  share of the range
 * @param stop      ends the branch under way; what is there is kept
 */
void follow_branches(const SceneFamily &family, const std::vector<coupling::PeriodicSolution> &solutions,
                     const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                     const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                     PeriodicResult &result);

} // namespace gestell::apps
