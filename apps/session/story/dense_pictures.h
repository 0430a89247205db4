#pragma once

#include "apps/output/values/result.h"

namespace gestell::apps
{

/**
 * Adds pictures around the main peak so densely that its vibration is visible: sixteen per period, over one and a half
 * periods before and after, from the states kept around the peak.  Sets PeakState::half_swing from the signal's turning
 * points.  No effect without kept states or turning points.
 */
void add_dense_pictures(coupling::RunResult &run, PeakState &peak);

} // namespace gestell::apps
