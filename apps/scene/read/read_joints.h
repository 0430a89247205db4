#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Reads all [place.NAME] and [measure.NAME] and makes them known to `names`.
void read_places(const SceneTable &scene, Names &names, Scene &result);

/// Reads all [joint.NAME] into the scene.
void read_joints(const SceneTable &scene, const Names &names, Scene &result);

} // namespace gestell::apps
