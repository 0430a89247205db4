#pragma once

#include "apps/output/values/result.h"

namespace gestell::apps
{

/**
 * Pictures so close around the main peak that the vibration which makes it is seen: sixteen a period, one and a half
 * periods to either side, of the states kept around it.  Fills PeakState::half_swing by the signal's turning points.
 * Nothing where no states are kept or the signal does not turn.
 */
void add_dense_pictures(coupling::RunResult &run, PeakState &peak);

} // namespace gestell::apps
