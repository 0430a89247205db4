#pragma once

#include "apps/analysis/stages/stage_result.h"
#include "apps/scene/values/requests.h"
#include "apps/session/prepared_machine.h"
#include "coupling/simulation/run_result.h"

namespace gestell::apps
{

/**
 * What rings in the last stage of `result`, from the last event of a contact on: oscillations found by
 * coupling::matrix_pencil(), with the modes of the machine linearised at rest where its driven joints stand at the end.
 * Large swings make others: what lies within 1.5 % of k s_i (k = 2, 3, 4) or s_i +- s_j of stronger ones is named as
 * that combination. Too few samples, or no equilibrium to compare with, are told in `result.ringing.note`.
 */
void find_ringing(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state,
                  const coupling::RunResult &run, StageResult &result);

} // namespace gestell::apps
