#pragma once

#include "apps/session/prepared_machine.h"

#include <list>
#include <memory>
#include <string>
#include <utility>

namespace gestell::apps
{

/// Whether the scene's machine is built on a reduced frame only.
bool on_reduced_frame(const Scene &scene);

/// Whether the reduced frames of two scenes are equal.
bool same_frame(const Scene &a, const Scene &b);

/// The frame as a machine needs it, without data for pictures and reports.
coupling::ReducedFrame without_pictures(coupling::ReducedFrame frame);

/// A scene with its machine.
struct PreparedScene
{
  std::unique_ptr<Scene>           scene;
  std::unique_ptr<PreparedMachine> prepared;
};

/// @param frame  reduced frame to use; null: that of the scene
PreparedScene prepared_scene(Scene scene, const coupling::ReducedFrame *frame);

/**
 * Reduced frames that runs share: the last used ones are kept in memory, all of them in the frame cache.  If several
 * processes need the same frame, one of them reduces it and the others wait.
 */
class ReducedFrameStore
{
public:
  /// @param drawn  results of runs are written, so that frames keep the data for pictures
  explicit ReducedFrameStore(bool drawn) : drawn_(drawn) {}

  /// Null for a scene that is not on_reduced_frame().  A frame file that was replaced is read again.
  std::shared_ptr<const coupling::ReducedFrame> frame(const Scene &scene, const coupling::Progress &progress);

private:
  using Kept = std::pair<std::string, std::shared_ptr<const coupling::ReducedFrame>>;

  bool            drawn_;
  std::list<Kept> kept_; ///< the last used one first
};

} // namespace gestell::apps
