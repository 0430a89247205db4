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

/// What a run did with a signal, as far as it was sampled.
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
  double largest() const { return most > -least ? most : -least; } ///< amount
  double t_largest() const { return most > -least ? t_most : t_least; }
};

/// Signals that are followed without rows in the history.
struct WatchedSignals
{
  std::vector<Signal>       signals;
  std::vector<WatchedValue> values; ///< of these, after the run; empty: it did not start
};

/// simulate() that keeps checkpoints and goes on from one, and follows signals; null: neither.
/// @throws std::runtime_error besides if the state is that of another run
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop, Trajectory *trajectory, const RunCheckpoints *checkpoints,
                   WatchedSignals *watched = nullptr);

} // namespace gestell::coupling
