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

/**
 * Checks a run before it starts.
 *
 * @throws std::invalid_argument for parameters out of range, an end before the start, a step longer than the period of
 * a load, and more than 1 GB of history and pictures (unless allowed), with the size and the remedy.
 */
void check_run(const Machine &machine, const RunOptions &options, std::size_t n_signals);

/// Only computes the initial forces and accelerations.
/// @throws ConvergenceFailure if there are none; std::invalid_argument if the method cannot treat the machine
void try_start(Machine &machine, const InitialState &initial, const RunOptions &options);

/// Integrates from `initial` to options.end.  A ConvergenceFailure is reported in `failure`, with all results up to
/// then; there are none if the machine does not start.  `progress` is called from time to time with the time reached;
/// `stop` ends the run early; `trajectory` receives the motion.
/// @throws std::invalid_argument as check_run() and StabilityGuard::check() do, and if the method cannot treat the
/// machine.
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress = {},
                   const std::atomic<bool> *stop = nullptr, Trajectory *trajectory = nullptr);

} // namespace gestell::coupling
