#pragma once

#include "apps/output/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// What is known about the frame, line by line for people: mass by parts, centre and inertia, the check of rigid
/// motions, motions that are free, damping.
std::vector<std::string> frame_lines(const ModelFacts &model);

} // namespace gestell::apps
