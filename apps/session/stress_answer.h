#pragma once

#include "apps/output/values/stress_result.h"
#include "apps/scene/values/requests.h"
#include "coupling/frame/reduced_frame.h"
#include "coupling/simulation/simulation.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// @throws std::invalid_argument if the scene asks for stresses and the frame (null: none) does not know them.
void require_stress(const Scene &scene, const coupling::ReducedFrame *frame);

/// Stresses at the instants [output.stress] asks for, from the states the run kept.  What the run did not reach is told
/// in `warnings`.
StressResult stress_answer(const Scene &scene, const coupling::ReducedFrame &frame, const coupling::RunResult &run,
                           std::vector<std::string> &warnings);

} // namespace gestell::apps
