#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Elements whose force depends explicitly on time, for fixed measures and rates.
 *
 * For instants t within `span` [s] after that of the state, the force at t + shift is compared with that at t, with a
 * tolerance of 1e-9 of its largest change.
 *
 * @param shift  [s] possible period of the force; 0: returns all elements that depend on time
 */
std::vector<std::string> forces_of_time(const Machine &machine, const InitialState &state, double span, double shift);

/// The same for ideal joints and the rates [m/s, rad/s] that they prescribe.
std::vector<std::string> motions_of_time(const Machine &machine, const InitialState &state, double span, double shift);

} // namespace gestell::coupling
