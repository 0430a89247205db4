#pragma once

#include "apps/output/values/stress_result.h"
#include "apps/scene/values/requests.h"
#include "coupling/frame/reduced_frame.h"
#include "coupling/simulation/simulation.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// @throws std::invalid_argument if the scene requests stresses and the frame (null: none) has no stress recovery.
void require_stress(const Scene &scene, const coupling::ReducedFrame *frame);

/// Stresses at the instants requested by [output.stress], from the states that the run kept.  Requested instants that
/// the run did not reach are listed in `warnings`.
StressResult stress_answer(const Scene &scene, const coupling::ReducedFrame &frame, const coupling::RunResult &run,
                           std::vector<std::string> &warnings);

} // namespace gestell::apps
