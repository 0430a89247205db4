#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/simulation/resumable_run.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Where and how often a run saves its state, so that an interrupted run can be resumed.
struct CheckpointRequest
{
  std::filesystem::path file;
  double                every  = 30.;   ///< [s] of wall time; 0: only at an interruption
  bool                  resume = false; ///< from the saved state
  std::function<void()> claim{};        ///< called before the file is written, to reserve it
};

/// The same for simulate(); `machine` and `warnings` must outlive it.
/// @param warnings  receives, once, the reason why states could not be saved: a full disk does not end a run
/// @throws std::invalid_argument as read_checkpoint() does
coupling::RunCheckpoints run_checkpoints(const CheckpointRequest &request, const SceneNode &scene,
                                         const coupling::Machine &machine, const coupling::InitialState &start,
                                         std::vector<std::string> &warnings);

} // namespace gestell::apps
