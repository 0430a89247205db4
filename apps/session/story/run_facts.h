#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/session.h"
#include "apps/session/story/local_modes.h"

#include <vector>

namespace gestell::apps
{

/**
 * Signals of an object at its located events: displacements and rates just before, forces just before and after, and
 * the impulse of a force until the next event of its object, by the trapezoidal rule if the interval contains ten rows
 * or more.  Events that were skipped have no values.
 */
std::vector<EventValue> event_log(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                  const Result &result);

/**
 * Extremes of forces and torques during the run, each with its half-cycle: from the turning point at the extreme to the
 * nearer adjacent one, if it contains ten rows or more.  For a half-cycle with kept states: the mode of the machine
 * there that contributes most to the change of the force (swing_changes()), with its share, and the sum over all modes.
 */
std::vector<ExtremeSwing> extreme_swings(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes);

/// Adds these, the load durations and the clearance estimates to the result of Session::run(), if it has events.
void add_story(Session &session, Result &result);

} // namespace gestell::apps
