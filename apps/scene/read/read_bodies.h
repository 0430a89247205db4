#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/scene.h"

namespace gestell::apps
{

/// Reads all [body.NAME], in the order of the file, and makes them known to `names`.
std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names, fem::Scripts scripts);

/// Reads all [element.NAME] into the scene.
void read_elements(const SceneTable &table, const Names &names, Scene &scene);

} // namespace gestell::apps
