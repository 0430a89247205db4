#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/session.h"
#include "apps/session/story/modes_there.h"

#include <vector>

namespace gestell::apps
{

/**
 * A run told by its located events and by the extremes of its forces, in the order of time.
 *
 * Of an event: the forces of its object just before it and, where they jump, behind it; the rates of its displacements
 * before it; and how much momentum its force passes on until the object's next event (trapezoids from event to event
 * over the rows, where these are a tenth of that time apart or closer).  Nothing of that where the run went over the
 * event.  Repetitions of a kind are told twice, then counted; of more than sixty sentences the latest events are left
 * out, which is said, never extremes.  Of an extreme of a force or torque: the vibration that it belongs to, by the
 * time between its neighbouring turning points, half a period (twenty rows or more); whether it follows the force of a
 * tool, which makes between half and twice its value and its change; else the mode of the machine there that makes
 * most of the change between them, see swing_changes(): it carries the swing if it makes between 0.5 and 1.2 of it and
 * its frequency differs from the swing's by less than a quarter.  No mode is named where the sum over all modes misses
 * the change by more than a fifth, as of forces that positions do not tell.
 */
std::vector<StorySentence> story_sentences(const std::vector<coupling::Signal> &signals,
                                           const coupling::Machine &machine, const Result &result, ModesOfRun &modes);

/// Adds the story to the result of Session::run(), if that has events.
void add_story(Session &session, Result &result);

} // namespace gestell::apps
