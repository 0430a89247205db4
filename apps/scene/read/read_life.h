#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/life_request.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Reads [life]; requests stresses from the frame and states from the run.  `result` already has its frame and run.
/// @throws std::invalid_argument for a frame without stresses, unknown surfaces, incomplete curves and welds
void read_life(const SceneTable &scene, Scene &result);

/// Keys of [life], of its curve, of [[life.weld]] and [[life.block]].
const std::vector<Key> &life_keys();
const std::vector<Key> &curve_keys();
const std::vector<Key> &weld_keys();
const std::vector<Key> &block_keys();

} // namespace gestell::apps
