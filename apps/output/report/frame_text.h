#pragma once

#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Facts about the frame, one line each, for people: mass by parts, centre and inertia, the check of rigid-body
/// motions, rigid-body modes, damping.
std::vector<std::string> frame_text(const ModelFacts &model);

/// Whether any mode has a refined frequency.
bool any_refined(const std::vector<coupling::Mode> &modes);

/// Explains refined frequencies and their relation to those of the model and of the full frame.
extern const char *const refined_words;

/// Explains the static residual of the retained modes, and when it matters.
extern const char *const static_residual_words;

/**
 * Note to print between two successive modes if the second is the first one above the frequency limit of the reduced
 * frame; else empty.
 */
std::string words_above(double limit, double before, double frequency);

} // namespace gestell::apps
