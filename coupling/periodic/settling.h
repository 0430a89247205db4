#pragma once

#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// Why exact propagation, whose tangents shooting needs, cannot treat the system, and that `instead` serves; empty: it
/// can.
std::string why_not_propagated(const SecondOrderSystem &system, const std::string &instead);

/// Integrates the periods of the option "lead-in", less where the motion closes to a percent before, and makes their
/// end the guess.
void lead_in(PeriodFlow &flow, const PeriodicProblem &problem, const PeriodicOptions &options, PeriodicGuess &guess);

/**
 * Integrates period by period until (5.5.4/1) holds to the tolerance, and tells how many periods that took.  What it
 * finds is stable, and but one of several such motions.
 *
 * Raised damping, by the option "damping" D of critical, is put on the whole motion as -2 D omega M q' and set back by
 * a tenth part a period.
 */
const PeriodicMethod &settling_method();

} // namespace gestell::coupling
