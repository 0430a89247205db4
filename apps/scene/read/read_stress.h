#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// [output.stress]: at which instants stresses are told.  Asks the frame for them and the run for the states; `result`
/// has its frame, run and signals already.
/// @throws std::invalid_argument for a frame that knows no stresses, instants outside the run and unknown signals.
void read_stress(const SceneTable &output, Scene &result);

/// Of [output.stress].
const std::vector<Key> &stress_keys();

} // namespace gestell::apps
