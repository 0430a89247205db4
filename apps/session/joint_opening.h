#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The signals of a run with the normal forces of joints that close, which it watches; those asked for already are not
/// added.
std::vector<coupling::Signal> with_normal_forces(const Scene &scene, const coupling::Machine &machine,
                                                 std::vector<coupling::Signal> signals);

/// Joints whose normal force became a pull in the run: there the linear frame no longer holds.
std::vector<std::string> opening_joints(const Scene &scene, const std::vector<coupling::Signal> &signals,
                                        const coupling::RunResult &run);

} // namespace gestell::apps
