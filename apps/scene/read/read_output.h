#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Reads [output]: signals, and the times between rows and pictures.
void read_output(const SceneTable &scene, Scene &result);

/// Requests stresses from the frame and its parts.
/// @param asking  the table that needs them
/// @throws std::invalid_argument for a frame that has none
void request_stresses(const SceneTable &asking, Scene &scene);

/// Keys of [output]; of a signal with `from` in it; of [output.stress] and [output.stages].
const std::vector<Key> &output_keys();
const std::vector<Key> &watched_signal_keys();
const std::vector<Key> &stress_keys();
const std::vector<Key> &stage_keys();

} // namespace gestell::apps
