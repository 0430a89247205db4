#pragma once

#include "apps/output/values/stage_result.h"
#include "apps/scene/values/requests.h"
#include "apps/session/prepared_machine.h"
#include "coupling/simulation/run_result.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Intervals between the events "lift_off" and "touch_down" of each wheel; one that begins in the air comes down first.
std::vector<LiftOff> lift_off_intervals(const coupling::RunResult &run, double begin, double end);

/**
 * The stages of [output.stages], what rings in the last one, and when wheels were off the ground; nothing of a run
 * without both.  Modes are identified from the last event of a contact on, by matrix_pencil(), and compared with those
 * of the machine linearised at rest where its driven joints stand in the end.
 *
 * A border that the run did not come to, or that lies at its begin, is its failure, unless it has one already: the
 * signal of the switch, how far it came, what it needs and what may be changed.
 */
std::optional<StageResult> stage_answer(const Scene &scene, PreparedMachine &prepared, const Eigen::VectorXd &end_state,
                                        coupling::RunResult &run);

} // namespace gestell::apps
