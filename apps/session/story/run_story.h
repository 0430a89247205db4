#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/session.h"

#include <vector>

namespace gestell::apps
{

/**
 * A run told by its located events and by the extremes of its forces, in the order of time.
 *
 * Of an event: what the signals of its object show; what of them moves at a rate, and how much momentum its force
 * passes on until the object's next event (the integral of the force over the history).  Repetitions of a kind are told
 * twice, then counted.  Of an extreme of a force or torque: the vibration that it belongs to, by the time between its
 * neighbouring turning points, half a period, and the mode next to it in frequency with what it strains.
 */
std::vector<StorySentence> story_sentences(const std::vector<coupling::Signal> &signals,
                                           const coupling::Machine &machine, const Result &result);

/// Adds the story to the result of Session::run(), if that has events.
void add_story(Session &session, Result &result);

} // namespace gestell::apps
