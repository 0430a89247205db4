#pragma once

#include "coupling/simulation/resumable_run.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace gestell::coupling
{

/// Asks now and then for the state of a run, so that it could go on from there.
class CheckpointPace
{
public:
  CheckpointPace(const RunCheckpoints *checkpoints, std::function<std::string()> state)
      : checkpoints_(checkpoints), state_(std::move(state))
  {
  }

  bool is_due() const { return checkpoints_ && checkpoints_->every > 0. && Clock::now() >= due_; }

  /// The next one is due so late that keeping them takes half a per cent of the time.
  void keep()
  {
    if (!checkpoints_)
      return;
    const Clock::time_point from = Clock::now();
    checkpoints_->keep(state_());
    const std::chrono::duration<double> cost = Clock::now() - from;
    due_ = Clock::now() + length(std::max(checkpoints_->every, cost.count() / share_of_checkpoints));
  }

private:
  using Clock                                  = std::chrono::steady_clock;
  static constexpr double share_of_checkpoints = 0.005;

  static Clock::duration length(double seconds)
  {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  const RunCheckpoints        *checkpoints_;
  std::function<std::string()> state_;
  Clock::time_point            due_ = Clock::now() + length(checkpoints_ ? std::min(checkpoints_->every, 1e6) : 0.);
};

} // namespace gestell::coupling
