#pragma once

#include "apps/scene/file/scene_node.h"
#include "coupling/simulation/resumable_run.h"

#include <filesystem>

namespace gestell::apps
{

/// Where a run keeps its state now and then, so that one that was stopped goes on.
struct CheckpointRequest
{
  std::filesystem::path file;
  double                every  = 30.;   ///< [s] of wall time; 0: at an interruption alone
  bool                  resume = false; ///< from the state that stands there
};

/// The same for simulate(); `machine` must outlive it.
/// @throws std::invalid_argument as read_checkpoint()
coupling::RunCheckpoints run_checkpoints(const CheckpointRequest &request, const SceneNode &scene,
                                         const coupling::Machine &machine, const coupling::InitialState &start);

} // namespace gestell::apps
