#pragma once

#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * The scene as it was understood, for people, a line each: frame with its interfaces, bodies, joints, laws, coordinates
 * and freedoms, start, what is computed and about how long that takes.  Nothing is computed; a frame that must be made
 * first is counted by its interfaces.
 */
std::vector<std::string> scene_summary(const Scene &scene);

} // namespace gestell::apps
