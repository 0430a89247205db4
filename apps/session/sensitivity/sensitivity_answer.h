#pragma once

#include "apps/output/values/result.h"
#include "apps/session/sensitivity/perturbed_scenes.h"
#include "coupling/simulation/trajectory.h"

#include <atomic>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Derivatives of all that a run tells: docs/sensitivities.md.
/// @param result      with the run and its modes; warnings are added
/// @param trajectory  of the run
/// @param stop        ends it, which keeps what is known by then; null: nothing does
SensitivityResult sensitivity_answer(const Scene &scene, PreparedMachine &prepared, PerturbedScenes &twins,
                                     const std::vector<VariedKey> &keys, const std::vector<coupling::Signal> &signals,
                                     const coupling::Trajectory &trajectory, const std::atomic<bool> *stop,
                                     Result &result);

} // namespace gestell::apps
