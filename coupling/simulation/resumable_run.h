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

/// Checkpoints of a run, so that an interrupted run can be resumed.
struct RunCheckpoints
{
  std::string                              from; ///< state to resume from, of an identical run; empty: none
  std::function<void(const std::string &)> keep; ///< stores a state
  double                                   every =
      30.; ///< [s] of wall time between two; longer if storing them takes more than 0.5 %; 0: only when stopped
};

/// Extremes of a signal over a run, as far as it was sampled.
struct WatchedValue
{
  bool   known = false; ///< false: it never had a finite value
  double first = 0., last = 0., least = 0., most = 0., t_least = 0., t_most = 0.;

  void take(double t, double value)
  {
    if (!known)
      *this = {true, value, value, value, value, t, t};
    last = value;
    if (value < least)
      least = value, t_least = t;
    if (value > most)
      most = value, t_most = t;
  }
  double largest() const { return most > -least ? most : -least; } ///< largest absolute value
  double t_largest() const { return most > -least ? t_most : t_least; }
};

/// Signals that are monitored without rows in the history.
struct WatchedSignals
{
  std::vector<Signal>       signals;
  std::vector<WatchedValue> values; ///< of these signals, after the run; empty: it did not start
};

/// simulate() with checkpoints, resuming and monitored signals; null: without.
/// @throws also std::runtime_error if the state is that of another run
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop, Trajectory *trajectory, const RunCheckpoints *checkpoints,
                   WatchedSignals *watched = nullptr);

} // namespace gestell::coupling
