#pragma once

#include "apps/scene/variant.h"
#include "apps/session/checkpoint/run_checkpoints.h"
#include "apps/session/partition.h"
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

/// Callback for the progress of a session, and a flag to interrupt it.
struct Watch
{
  coupling::Progress       progress{};             ///< phase, and its completed share; negative: unknown
  const std::atomic<bool> *interruption = nullptr; ///< ends a run, which retains its results; null: no interruption
};

/// The reduced frame of a scene.
struct FrameAnswer : coupling::CachedFrame
{
  ModelFacts facts;
};

/**
 * A scene that has been read, and the computations with it. Results are values: nothing is printed or written to files.
 *
 *     Session session("press.toml", {"run.step=1e-5"});
 *     const Result run = session.run();
 *
 * Wrong input throws std::invalid_argument with its location; a frame or modes that cannot be computed throw
 * ConvergenceFailure.  A run that fails or is interrupted returns a result with the reason.
 */
class Session
{
public:
  /// @param overrides  "key.path=value"
  explicit Session(const std::string &path, const std::vector<std::string> &overrides = {},
                   fem::Scripts scripts = fem::Scripts::harmless, const Watch &watch = {});
  explicit Session(Variant variant, const Watch &watch = {});
  /// @param scene  scene of the variant, possibly with fewer outputs
  Session(Variant variant, Scene scene, const Watch &watch);

  const Scene             &scene() const { return scene_; }
  const Variant           &variant() const { return variant_; } ///< to vary its keys further
  const std::atomic<bool> *interruption() const { return watch_.interruption; }
  /// Another scene, read from its file, with the progress and the interruption flag of this session (must outlive it).
  std::unique_ptr<Session> beside(const std::string &file) const;

  void check();     ///< checks that need no computation
  void check_run(); ///< also checks [run]

  /// The machine of the scene, built at the first call: the frame is read from the cache, or reduced and stored there.
  PreparedMachine &machine();
  /// Continues with another value of a key, "parameters.n=3".
  void vary(const std::string &change);
  /// Replaces the machine by one on this frame, for example of a finer mesh.
  void use_frame(const coupling::ReducedFrame &frame);

  /// Only the reduced frame; the scene's frame must be one that is reduced (frame_path()).
  FrameAnswer reduced_frame();
  /// Reasons why the interface coordinates are retained.
  Partition partition();
  /// Modes of the frame and of the coupled machine.
  Result modes(coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);
  /// Result of a command: model and modes, extended by `add` from machine().
  Result answered(const std::string &command, const std::function<void(Result &)> &add,
                  coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included);
  /// Makes later runs keep the states around the peaks of forces: pictures become dense around the main peak, and
  /// add_story() determines the modes in the peaks.  Costs some run time.
  void keep_swings() { swings_ = true; }
  /// For the next run.
  void keep_checkpoints(const CheckpointRequest &request) { checkpoints_ = request; }
  /// Time integration of the scene, with modes, stresses and warnings.
  /// @throws std::invalid_argument as read_checkpoint() does
  /// @param parts  additional answers of the run
  Result run(const RunParts &parts = {});

  /// Wall time [s] of all computations so far, by phase.
  const std::vector<std::pair<std::string, double>> &wall_seconds() const { return times_.seconds(); }

  /// Times a phase and reports it to the watch; for computations outside the session, which must outlive it.
  coupling::Progress progress();

private:
  coupling::RunResult simulated(const coupling::InitialState &initial, const std::vector<coupling::Signal> &signals,
                                coupling::Trajectory *trajectory, std::vector<std::string> &warnings);
  Result              finished(Result result);

  Variant                          variant_;
  Scene                            scene_;
  Watch                            watch_;
  PhaseTimes                       times_;
  std::shared_ptr<PreparedMachine> machine_; ///< shared with results, which compute its forces when they are written
  bool                             checked_ = false, swings_ = false;
  std::optional<CheckpointRequest> checkpoints_;
};

} // namespace gestell::apps
