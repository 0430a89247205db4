#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/session.h"
#include "apps/session/story/local_modes.h"

#include <vector>

namespace gestell::apps
{

/**
 * Signals of an object at its located events: displacements and rates just before, forces just before and behind, and
 * what a force passes on until the next event of its object, by trapezoids over the rows where these are a tenth of
 * that time apart or closer.  Events that the run went over have no values.
 */
std::vector<EventValue> event_log(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                  const Result &result);

/**
 * Extremes of forces and torques inside the run, each with the swing about it: from the turning point there to the
 * nearer one beside it, where rows are a twentieth of half its period apart or closer.  Of a swing whose states were
 * kept: the mode of the machine there that makes most of the force's change, see swing_changes(), with its share, and
 * the sum over all modes.
 */
std::vector<ExtremeSwing> extreme_swings(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes);

/// Adds these, the loads and the plays to the result of Session::run(), if that has events.
void add_story(Session &session, Result &result);

} // namespace gestell::apps
