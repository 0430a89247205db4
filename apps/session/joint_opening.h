#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The signals of a run plus the normal forces of contact joints, which have to be monitored; no signal is added twice.
std::vector<coupling::Signal> with_normal_forces(const Scene &scene, const coupling::Machine &machine,
                                                 std::vector<coupling::Signal> signals);

/// Joints whose normal force became tensile in the run: from there the linear frame is not valid.
std::vector<std::string> opening_joints(const Scene &scene, const std::vector<coupling::Signal> &signals,
                                        const coupling::RunResult &run);

} // namespace gestell::apps
