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
 * [s] start of the interval in which extremes are evaluated, key `from` of [output].  The last period is the least
 * common one of the loads with harmonics, or else a revolution of the slowest rotor that makes at least one revolution
 * in the run at its initial speed.
 *
 * @throws std::invalid_argument if the scene requests the last period and the machine has none in its run, or if a
 *         force or a prescribed motion is not periodic with it
 */
double result_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial);

/// After a run whose window is a revolution of a rotor: adds a warning if the rotor did not keep its speed.
void check_window(const Scene &scene, const coupling::Machine &machine, const coupling::InitialState &initial,
                  coupling::RunResult &run);

} // namespace gestell::apps
