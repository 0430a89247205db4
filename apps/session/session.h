#pragma once

#include "apps/scene/variant.h"
#include "apps/session/checkpoint/run_checkpoints.h"
#include "apps/session/partition.h"
#include "apps/session/periodic_request.h"
#include "apps/session/phase_times.h"
#include "apps/session/prepared_machine.h"
#include "apps/session/run_part.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Receives the progress of a session, and may interrupt it.
struct Watch
{
  coupling::Progress       progress{};             ///< phase, and the share of it that is done; negative: unknown
  const std::atomic<bool> *interruption = nullptr; ///< ends a run, which keeps what it has; null: nothing does
};

/// The reduced frame of a scene.
struct FrameAnswer : coupling::CachedFrame
{
  ModelFacts facts;
};

/**
 * A scene that has been read, and what can be computed with it, as values: no terminal, no files of results.
 *
 *     Session session("press.toml", {"run.step=1e-5"});
 *     const Result run = session.run();
 *
 * Wrong input throws std::invalid_argument with its place, a frame or modes that cannot be found ConvergenceFailure; a
 * run that fails or is interrupted is a result, with the reason in it.
 */
class Session
{
public:
  /// @param overrides  "key.path=value"
  explicit Session(const std::string &path, const std::vector<std::string> &overrides = {},
                   fem::Scripts scripts = fem::Scripts::harmless, const Watch &watch = {});
  explicit Session(Variant variant, const Watch &watch = {});
  /// @param scene  that of the variant, which may compute less
  Session(Variant variant, Scene scene, const Watch &watch);

  const Scene             &scene() const { return scene_; }
  const Variant           &variant() const { return variant_; } ///< to vary its entries further
  const std::atomic<bool> *interruption() const { return watch_.interruption; }
  /// Another scene, as in its file, with the progress and the interruption of this one, which must outlive it.
  std::unique_ptr<Session> beside(const std::string &file) const;

  void check();     ///< what can be known without computing
  void check_run(); ///< that it says how to run, too

  /// Its machine, made at the first call: the frame is taken from the cache or reduced and kept there.
  PreparedMachine &machine();
  /// The machine on this frame instead, of a finer mesh.
  void use_frame(const coupling::ReducedFrame &frame);

  /// The reduced frame alone; the scene's frame must be one that is reduced (frame_path()).
  FrameAnswer reduced_frame();
  /// Why the coordinates of its interfaces are kept.
  Partition partition();
  /// Modes of the frame and of the coupled machine.
  Result modes(coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);
  /// Model and modes, as of every command, with what `add` finds of machine().
  Result answered(const std::string &command, const std::function<void(Result &)> &add,
                  coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);
  /// From here on runs keep the states around the peaks of forces: pictures become dense around the main one, and
  /// add_story() tells which modes make them.  Takes some of their time.
  void keep_swings() { swings_ = true; }
  /// For the run to come.
  void keep_checkpoints(const CheckpointRequest &request) { checkpoints_ = request; }
  /// The scene simulated in time, with modes, stresses and warnings.
  /// @throws std::invalid_argument as read_checkpoint()
  /// @param parts  what is found of it besides
  Result run(const RunParts &parts = {});

  /// Periodic motions of the scene's machine, with their stability; the first stable one as a run of one period.
  Result periodic(const PeriodicRequest &request = {});

  /// Of all that was computed so far, by phase.
  const std::vector<std::pair<std::string, double>> &wall_seconds() const { return times_.seconds(); }

  /// Times a phase and tells it to the watch; for what is computed beside the session, which must outlive it.
  coupling::Progress progress();

private:
  coupling::RunResult simulated(const coupling::InitialState &initial, const std::vector<coupling::Signal> &signals,
                                coupling::Trajectory *trajectory, std::vector<std::string> &warnings);
  Result              periodic_here(const PeriodicRequest &request);
  PeriodicResult      periodic_motions(const PeriodicRequest &request, Result &result);
  Result              finished(Result result);

  Variant                          variant_;
  Scene                            scene_;
  Watch                            watch_;
  PhaseTimes                       times_;
  std::shared_ptr<PreparedMachine> machine_; ///< shared with results, which tell its forces when they are written
  bool                             checked_ = false, swings_ = false;
  std::optional<CheckpointRequest> checkpoints_;
  std::unique_ptr<Session>         begin_; ///< of a branch: results draw its machine
};

} // namespace gestell::apps
