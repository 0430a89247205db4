#pragma once

#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// What is known about the frame, line by line for people: mass by parts, centre and inertia, the check of rigid
/// motions, motions that are free, damping.
std::vector<std::string> frame_text(const ModelFacts &model);

/// Some mode has a refined frequency.
bool any_refined(const std::vector<coupling::Mode> &modes);

/// What refined frequencies are and how they lie to those of the model and of the full frame.
extern const char *const refined_words;

/// What the static load that the modes do not carry means, and when it matters.
extern const char *const static_residual_words;

/**
 * What is to be told between two successive modes of which the second is the first above the frequency that a reduced
 * frame is made for; else empty.
 *
 * @param limit  [Hz]; nan: none
 */
std::string words_above(double limit, double before, double frequency);

} // namespace gestell::apps
