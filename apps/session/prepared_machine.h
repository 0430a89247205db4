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

/// Tells that a phase begins or goes on, share 0..1 of it done, negative: unknown; `progress` may be empty.
void tell(const coupling::Progress &progress, const std::string &phase, double share = -1.);

/// The same progress of a frame, which throws std::runtime_error once `stop` is set while gmsh is at work: nothing is
/// there yet that should be saved.  @param stop  null: nothing stops it
coupling::Progress stoppable(coupling::Progress progress, const std::atomic<bool> *stop);

/// How a machine in modes p relates to the one it is made of.
struct MachineInModes
{
  std::optional<coupling::Machine> whole;      ///< on an unreduced frame; none: the companion is it
  Eigen::MatrixXd                  companion;  ///< [n_c x m] p in the companion's coordinates
  Eigen::MatrixXd                  projection; ///< see SuperposedMachine
  double                           largest_step = 0., shortest_decay = 0.; ///< [s] see SuperposedMachine
  std::vector<std::string>         statements;
};

/// A scene's machine, ready to compute with.
struct PreparedMachine
{
  coupling::Machine machine;
  /// With an unreduced frame or in modes: the same machine on the reduced frame or in its own coordinates, which serves
  /// start, modes and pictures.
  std::optional<coupling::Machine> companion;
  std::vector<std::string>         warnings;

  const coupling::Machine &small() const { return companion ? *companion : machine; }
  coupling::Machine       &small() { return companion ? *companion : machine; }

  /// Of a machine in modes, null otherwise.
  std::shared_ptr<const MachineInModes> in_modes{};

  /// A state of the unreduced frame in the companion's coordinates: interfaces and bodies; its modes are left at rest.
  Eigen::VectorXd project(const Eigen::VectorXd &state) const;
};

/// Makes the frame the scene asks for (or takes the reduced one from the cache) and builds the machine on it.
/// @param on  a given reduced frame; null: none
PreparedMachine prepare_machine(const Scene &scene, const coupling::Progress &progress = {},
                                const coupling::ReducedFrame *on = nullptr);

/// Of a machine in modes a step of central differences that is stable, see the other keep_stable_step().
void keep_stable_step(PreparedMachine &prepared, RunRequest &run);

/// Its initial state, that of an unreduced frame expanded from the companion's.
coupling::InitialState prepare_start(const Scene &scene, PreparedMachine &prepared);

/// What the reduced frame of such a scene is made from.
coupling::FrameOrigin frame_origin(const Scene &scene);

/// The reduced frame of a scene with geometry or large matrices.
coupling::CachedFrame reduced_frame(const Scene &scene, const coupling::Progress &progress);

/// What is to be said where no mesh is known whose error could be told: of frames given by matrices; else empty.
std::string mesh_text(const FrameRequest &frame);

/// What is known about the model, for summary and report.
ModelFacts model_facts(const PreparedMachine &prepared);

/// What modes, run and reduce write alike: scene, version, model, modes, scenery.
Result begin_result(const Scene &scene, const std::string &command, PreparedMachine &prepared,
                    coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);

} // namespace gestell::apps
