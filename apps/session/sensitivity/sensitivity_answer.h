#pragma once

#include "apps/output/values/result.h"
#include "apps/session/sensitivity/scene_twins.h"
#include "coupling/simulation/trajectory.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Derivatives of all that a run tells: docs/sensitivities.md.
/// @param result      with the run and its modes; warnings are added
/// @param trajectory  of the run
SensitivityResult sensitivity_answer(const Scene &scene, PreparedMachine &prepared, SceneTwins &twins,
                                     const std::vector<VariedKey> &keys, const std::vector<coupling::Signal> &signals,
                                     const coupling::Trajectory &trajectory, Result &result);

} // namespace gestell::apps
