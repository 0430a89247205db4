#pragma once

#include "coupling/sensitivity/output_derivatives.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Relative change of a parameter at which neighbouring events coincide, to first order: beyond it they change order,
/// and derivatives are not valid. A sentence for each parameter with less than 1 %.
/// @param outputs  only those of events are used, in their order in time
/// @param near     [s] events closer than this coincide and shift together
std::vector<std::string> meeting_events(const std::vector<OutputDerivatives> &outputs,
                                        const std::vector<ParameterTwins> &twins, double near);

} // namespace gestell::coupling
