#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/scene.h"

namespace gestell::apps
{

/// [run]: the method with its parameters, times, events.  Without it nothing is run: `modes` and `reduce` need none.
RunRequest read_run(const SceneTable &scene);

/// "0.5 s", for messages.
std::string seconds(double t);

/// [output]: signals, and the times between rows and pictures.
void read_output(const SceneTable &scene, Scene &result);

} // namespace gestell::apps
