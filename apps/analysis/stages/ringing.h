#pragma once

#include "apps/analysis/stages/stage_result.h"
#include "apps/scene/values/requests.h"
#include "apps/session/prepared_machine.h"
#include "coupling/simulation/run_result.h"

namespace gestell::apps
{

/**
 * Identifies the ringing in the last stage of `result`, after the last contact event: oscillations found by
 * coupling::matrix_pencil(), compared with the modes of the machine linearised at rest in the final position of its
 * driven joints.  Large oscillations generate combinations: an oscillation within 1.5 % of k s_i (k = 2, 3, 4) or s_i
 * +- s_j of stronger ones is labelled as that combination.  If there are too few samples, or no equilibrium for
 * comparison, `result.ringing.note` gives the reason.
 */
void find_ringing(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state,
                  const coupling::RunResult &run, StageResult &result);

} // namespace gestell::apps
