#pragma once

#include "coupling/integration/events/event_driver.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Switches that never act, or act before anything has moved, are seldom meant.
void check_switches(const Machine &machine, double begin, const std::vector<Event> &events, RunOutcome &outcome);

/// Kind of the finding that a switch ended the run, as the scene specifies; the computation did not fail.
constexpr const char *ended_by_switch = "ended-by-switch";

/// Statement of the switch whose orders this event is, if they end the run; else empty.
std::string end_by_switch(const Machine &machine, double begin, const Event &event);

/// Positions that are given may lie inside a stop, which then throws the body out.
void check_closed_contacts(const Machine &machine, const InitialState &initial, RunOutcome &outcome);

/// Taken step by step, the sign of a friction is that of the last step: it may hold what it cannot.  Of the first dry
/// friction found.
void check_unlocated_friction(const Machine &machine, RunOutcome &outcome);

} // namespace gestell::coupling
