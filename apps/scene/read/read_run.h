#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// [run]: the method with its parameters, times, events.  Without it nothing is run: `modes` and `reduce` need none.
RunRequest read_run(const SceneTable &scene, bool in_modes);

/// Of [run].
const std::vector<Key> &run_keys();

/// "0.5 s", for messages.
std::string seconds(double t);

} // namespace gestell::apps
