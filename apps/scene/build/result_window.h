#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * [s] from which on extremes count, [output] from.  The last period is the least common one of the loads with
 * harmonics, else a revolution of the slowest rotor that turns once in the run at the speed it starts with.
 *
 * @throws std::invalid_argument if the scene asks for the last period of a machine that has none in its run, or where a
 *         force or a prescribed motion does not repeat with it
 */
double result_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial);

/// After a run whose window is a revolution of a rotor: adds a warning if the rotor did not keep its speed.
void check_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial,
                  coupling::RunResult &run);

} // namespace gestell::apps
