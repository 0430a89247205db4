#pragma once

#include "coupling/sensitivity/parameter_twins.h"
#include "coupling/sensitivity/run_sensitivities.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// By which share of its value a parameter makes neighbouring events meet, to first order: beyond it they change
/// places, and derivatives say nothing.  A sentence for each parameter of which less than 1 % does.
/// @param outputs  those of events are looked at, in their order in time
/// @param near     [s] apart, events are at one instant and move together
std::vector<std::string> meeting_events(const std::vector<OutputDerivatives> &outputs,
                                        const std::vector<ParameterTwins> &twins, double near);

} // namespace gestell::coupling
