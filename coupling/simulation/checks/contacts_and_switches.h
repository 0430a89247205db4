#pragma once

#include "coupling/integration/events/event_driver.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Warns of switches that never trigger, or trigger before anything has moved: this is rarely intended.
void check_switches(const Machine &machine, double begin, const std::vector<Event> &events, RunOutcome &outcome);

/// Kind of the finding that a switch ended the run, as the scene specifies; the computation did not fail.
constexpr const char *ended_by_switch = "ended-by-switch";

/// Statement of the switch whose commands this event executes, if they end the run; else empty.
std::string end_by_switch(const Machine &machine, double begin, const Event &event);

/// Warns of given initial positions that penetrate a stop, which then throws the body out.
void check_closed_contacts(const Machine &machine, const InitialState &initial, RunOutcome &outcome);

/// Warns of dry friction whose events are not located: its sign is that of the last step, so that it may stick above
/// its limit. Only for the first one found.
void check_unlocated_friction(const Machine &machine, RunOutcome &outcome);

} // namespace gestell::coupling
