#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Elements whose force depends explicitly on the time, with measures and rates kept as in a state.
 *
 * Of instants t in `span` [s] from the state's own, the force at t + shift is compared with that at t: to 1e-9 of its
 * largest change.
 *
 * @param shift [s] after which it may repeat; 0: elements that depend on the time at all
 */
std::vector<std::string> forces_of_time(const Machine &machine, const InitialState &state, double span, double shift);

/// The same of ideal joints and the rates [m/s, rad/s] that they prescribe.
std::vector<std::string> motions_of_time(const Machine &machine, const InitialState &state, double span, double shift);

} // namespace gestell::coupling
