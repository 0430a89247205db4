#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// [output.stages]: between which events the run has which stages, and in which signals the last one rings.  `result`
/// has its signals and switches already, or reads them later: borders are looked for when the run is over.
/// @throws std::invalid_argument for numbers of names and borders that do not fit, and unknown signals
void read_stages(const SceneTable &output, Scene &result);

/// Of [output.stages].
const std::vector<Key> &stage_keys();

} // namespace gestell::apps
