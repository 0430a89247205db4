#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/simulation/resumable_run.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Where a run keeps its state now and then, so that one that was stopped goes on.
struct CheckpointRequest
{
  std::filesystem::path file;
  double                every  = 30.;   ///< [s] of wall time; 0: at an interruption alone
  bool                  resume = false; ///< from the state that stands there
  std::function<void()> claim{};        ///< the place of the file, before it is written
};

/// The same for simulate(); `machine` and `warnings` must outlive it.
/// @param warnings  gets, once, why states could not be kept: a full disk ends no run
/// @throws std::invalid_argument as read_checkpoint()
coupling::RunCheckpoints run_checkpoints(const CheckpointRequest &request, const SceneNode &scene,
                                         const coupling::Machine &machine, const coupling::InitialState &start,
                                         std::vector<std::string> &warnings);

} // namespace gestell::apps
