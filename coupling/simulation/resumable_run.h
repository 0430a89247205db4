#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"
#include "coupling/simulation/trajectory.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// What a run keeps of itself now and then, so that one that was stopped goes on.
struct RunCheckpoints
{
  std::string from; ///< state to go on from, of a run that is otherwise the same; empty: none
  std::function<void(const std::string &)> keep; ///< takes a state
  double                                   every =
      30.; ///< [s] of wall time between two; more where keeping them would take more than 0.5 %; 0: at a stop
};

/// simulate() that keeps checkpoints and goes on from one; null: neither.
/// @throws std::runtime_error besides if the state is that of another run
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop, Trajectory *trajectory, const RunCheckpoints *checkpoints);

} // namespace gestell::coupling
