#pragma once

#include "coupling/integration/events/event_driver.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Switches that never act, or act before anything has moved, are seldom meant.
/// @param to_the_end  the run neither failed nor was interrupted
std::vector<std::string> switch_warnings(const Machine &machine, double begin, const std::vector<Event> &events,
                                         bool to_the_end);

/// Statement of the switch whose orders this event is, if they end the run; else empty.
std::string end_by_switch(const Machine &machine, double begin, const Event &event);

/// Positions that are given may lie inside a stop, which then throws the body out.
std::vector<std::string> closed_contact_warnings(const Machine &machine, const InitialState &initial);

/// Taken step by step, the sign of a friction is that of the last step: it may hold what it cannot.  Of the first dry
/// friction found.
std::vector<std::string> unlocated_friction_warnings(const Machine &machine);

} // namespace gestell::coupling
