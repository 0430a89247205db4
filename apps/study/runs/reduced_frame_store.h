#pragma once

#include "apps/scene/scene.h"
#include "coupling/frame/reduced_frame_file.h"
#include "coupling/frame/reduction_options.h"

#include <list>
#include <memory>
#include <string>
#include <utility>

namespace gestell::apps
{

/**
 * Reduced frames that runs share: the few used last are kept in memory, all in the cache of frames.  Where several
 * processes need the same frame one of them reduces it and the others wait.
 */
class ReducedFrameStore
{
public:
  /// @param drawn  results of runs are written: frames keep what is drawn of them
  explicit ReducedFrameStore(bool drawn) : drawn_(drawn) {}

  /// Whether the scene's machine is built on a reduced frame, and on that alone.
  static bool serves(const Scene &scene);

  /// Null for a scene that it does not serve.  A file of a frame that was written anew is read anew.
  std::shared_ptr<const coupling::ReducedFrame> frame(const Scene &scene, const coupling::Progress &progress);

  int n_reduced() const { return n_reduced_; } ///< by this process, not found in the cache

private:
  using Kept = std::pair<std::string, std::shared_ptr<const coupling::ReducedFrame>>;

  bool            drawn_;
  std::list<Kept> kept_; ///< the one used last first
  int             n_reduced_ = 0;
};

} // namespace gestell::apps
