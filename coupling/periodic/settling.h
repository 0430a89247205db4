#pragma once

#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// Why exact propagation (tangents for shooting) cannot treat the system, with the alternative `instead`; empty: it
/// can.
std::string why_not_propagated(const SecondOrderSystem &system, const std::string &instead);

/// Integrates the periods of the option "lead-in", fewer if the periodicity residual is below 1 % before; their end
/// becomes the guess.
void lead_in(PeriodFlow &flow, const PeriodicProblem &problem, const PeriodicOptions &options, PeriodicGuess &guess);

/// "lead-in": the option for its number of periods.
PeriodicOption lead_in_option();
/// The options without lead-in: the search begins at the guess.
PeriodicOptions without_lead_in(PeriodicOptions options);

/**
 * Integrates period by period until (5.5.4/1) is satisfied within the tolerance, and returns the number of periods. The
 * solution is stable, and one of possibly several.
 *
 * Raised damping, by the option "damping" D of critical, is put on the whole motion as -2 D omega M q' and set back by
 * a tenth part a period.
 */
const PeriodicMethod &settling_method();

} // namespace gestell::coupling
