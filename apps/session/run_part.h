#pragma once

#include "apps/output/values/result.h"
#include "coupling/simulation/trajectory.h"

#include <string>
#include <vector>

namespace gestell::apps
{

class Session;

/// A run of a session while its machine and its trajectory are in memory.
struct RunInProgress
{
  Session                             &session;
  const std::vector<coupling::Signal> &signals;
  Result                              &result;       ///< model and modes; after the integration also the run
  coupling::Trajectory                 trajectory{}; ///< if a part needs it
};

/// An additional answer of a run; a run calls its parts in the order of the list.
class RunPart
{
public:
  virtual ~RunPart() = default;

  /// Its option, "--sensitivities", if it needs the trajectory: such a run saves no checkpoints.  Empty: it does not.
  virtual std::string needs_trajectory() const { return ""; }
  virtual void        before_motion(RunInProgress &) {}
  /// Called also for a run that failed or was interrupted, before its states are converted for pictures.
  virtual void after_motion(RunInProgress &) {}
};

using RunParts = std::vector<RunPart *>;

} // namespace gestell::apps
