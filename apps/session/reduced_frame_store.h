#pragma once

#include "apps/session/prepared_machine.h"

#include <list>
#include <memory>
#include <string>
#include <utility>

namespace gestell::apps
{

/// Whether the scene's machine is built on a reduced frame, and on that alone.
bool on_reduced_frame(const Scene &scene);

/// Whether frames reduced for two scenes are the same.
bool same_frame(const Scene &a, const Scene &b);

/// All that a machine needs of its frame.
coupling::ReducedFrame without_pictures(coupling::ReducedFrame frame);

/// A scene with its machine.
struct PreparedScene
{
  std::unique_ptr<Scene>           scene;
  std::unique_ptr<PreparedMachine> prepared;
};

/// @param frame  null: made as the scene says
PreparedScene prepared_scene(Scene scene, const coupling::ReducedFrame *frame);

/**
 * Reduced frames that runs share: the few used last are kept in memory, all in the cache of frames.  Where several
 * processes need the same frame one of them reduces it and the others wait.
 */
class ReducedFrameStore
{
public:
  /// @param drawn  results of runs are written: frames keep what is drawn of them
  explicit ReducedFrameStore(bool drawn) : drawn_(drawn) {}

  /// Null for a scene that is not on_reduced_frame().  A frame file that was replaced is read again.
  std::shared_ptr<const coupling::ReducedFrame> frame(const Scene &scene, const coupling::Progress &progress);

private:
  using Kept = std::pair<std::string, std::shared_ptr<const coupling::ReducedFrame>>;

  bool            drawn_;
  std::list<Kept> kept_; ///< the one used last first
};

} // namespace gestell::apps
