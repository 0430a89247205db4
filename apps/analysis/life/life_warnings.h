#pragma once

#include "apps/analysis/life/life_result.h"
#include "apps/scene/scene.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// What makes a life doubtful.
std::vector<std::string> life_warnings(const Scene &scene, const LifeResult &found);

} // namespace gestell::apps
