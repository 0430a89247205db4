#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// [output]: signals, and the times between rows and pictures.
void read_output(const SceneTable &scene, Scene &result);

} // namespace gestell::apps
