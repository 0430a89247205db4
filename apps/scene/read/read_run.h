#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Reads [run]: the method with its parameters, times, events.  It is optional: `modes` and `reduce` do not need it.
RunRequest read_run(const SceneTable &scene, bool in_modes);

/// Keys of [run].
const std::vector<Key> &run_keys();

/// "0.5 s", for messages.
std::string seconds(double t);

} // namespace gestell::apps
