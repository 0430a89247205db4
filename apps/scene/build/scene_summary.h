#pragma once

#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Summary of the scene for people, one fact per line: frame with its interfaces, bodies, joints, laws, coordinates and
 * DOFs, initial state, what is computed and an estimate of the time.  Nothing is computed; the DOFs of a frame that
 * must be computed first are counted from its interfaces.
 */
std::vector<std::string> scene_summary(const Scene &scene);

} // namespace gestell::apps
