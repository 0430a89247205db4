#pragma once

#include "apps/output/values/result.h"
#include "coupling/simulation/trajectory.h"

#include <string>
#include <vector>

namespace gestell::apps
{

class Session;

/// A run of a session while its machine and its motion are there.
struct RunInProgress
{
  Session                             &session;
  const std::vector<coupling::Signal> &signals;
  Result                              &result;       ///< model and modes; after the motion the run, too
  coupling::Trajectory                 trajectory{}; ///< the motion, where a part needs it
};

/// An answer of a run besides its signals; a run calls its parts in the order of the list.
class RunPart
{
public:
  virtual ~RunPart() = default;

  /// "--sensitivities", where it needs the trajectory: such a run keeps no checkpoints.  Empty: it does not.
  virtual std::string needs_trajectory() const { return ""; }
  virtual void        before_motion(RunInProgress &) {}
  /// Also of a run that failed or was interrupted; before its states become those of pictures.
  virtual void after_motion(RunInProgress &) {}
};

using RunParts = std::vector<RunPart *>;

} // namespace gestell::apps
