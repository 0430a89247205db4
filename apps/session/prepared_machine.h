#pragma once

#include "apps/output/values/result.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/frame/reduction_options.h"

#include <atomic>
#include <memory>
#include <optional>

namespace gestell::apps
{

/// Reports the phase and its completed share, 0 to 1; a negative share means: unknown.  `progress` may be empty.
void tell(const coupling::Progress &progress, const std::string &phase, double share = -1.);

/// The same progress for a frame; it throws std::runtime_error once `stop` is set while gmsh is running, because there
/// is nothing to save then.  @param stop  null: no interruption
coupling::Progress stoppable(coupling::Progress progress, const std::atomic<bool> *stop);

/// Relation between a machine in modes p and the machine it was made from.
struct MachineInModes
{
  std::optional<coupling::Machine> whole;      ///< machine on the unreduced frame; none: the companion is the original
  Eigen::MatrixXd                  companion;  ///< [n_c x m] maps p to the companion's coordinates
  Eigen::MatrixXd                  projection; ///< see SuperposedMachine
  double                           largest_step = 0., shortest_decay = 0.; ///< [s] see SuperposedMachine
  std::vector<std::string>         statements;
};

/// A scene's machine, ready for computations.
struct PreparedMachine
{
  coupling::Machine machine;
  /// For an unreduced frame or a machine in modes: the same machine on the reduced frame or in its own coordinates,
  /// which is used for initial state, modes and pictures.
  std::optional<coupling::Machine> companion;
  std::vector<std::string>         warnings;

  const coupling::Machine &small() const { return companion ? *companion : machine; }
  coupling::Machine       &small() { return companion ? *companion : machine; }

  /// For a machine in modes, null otherwise.
  std::shared_ptr<const MachineInModes> in_modes{};

  /// A state of the unreduced frame in the companion's coordinates: interfaces and bodies; modal coordinates are zero.
  Eigen::VectorXd project(const Eigen::VectorXd &state) const;
  /// Pictures of an unreduced frame show the companion.
  void project_pictures(coupling::RunResult &run) const
  {
    for (auto *states : {&run.picture_states, &run.picture_velocities})
      for (Eigen::VectorXd &state : *states)
        state = companion ? project(state) : state;
  }
};

/// Makes the frame of the scene (or reads the reduced one from the cache) and builds the machine on it.
/// @param on  reduced frame to use; null: that of the scene
PreparedMachine prepare_machine(const Scene &scene, const coupling::Progress &progress = {},
                                const coupling::ReducedFrame *on = nullptr);

/// For a machine in modes: limits the step of central differences to a stable one, see the other keep_stable_step().
void keep_stable_step(PreparedMachine &prepared, RunRequest &run);

/// Initial state of the machine; for an unreduced frame it is expanded from that of the companion.
coupling::InitialState prepare_start(const Scene &scene, PreparedMachine &prepared);

/// Inputs of the reduced frame of such a scene.
coupling::FrameOrigin frame_origin(const Scene &scene);

/// The reduced frame of a scene with geometry or large matrices.
coupling::CachedFrame reduced_frame(const Scene &scene, const coupling::Progress &progress);

/// A note that the mesh error is unknown, for frames given by matrices; else empty.
std::string mesh_text(const FrameRequest &frame);

/// Facts about the model for summary and report.
ModelFacts model_facts(const PreparedMachine &prepared);

/// Common part of the results of modes, run and reduce: scene, version, model, modes, scenery.
Result begin_result(const Scene &scene, const std::string &command, PreparedMachine &prepared,
                    coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);

} // namespace gestell::apps
