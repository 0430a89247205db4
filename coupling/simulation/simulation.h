#pragma once

#include "coupling/equilibrium/steady_start.h"
#include "coupling/integration/events/event_detection.h"
#include "coupling/integration/method.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "coupling/simulation/extreme_states.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct RunOptions
{
  MethodOptions method;
  double        begin = 0., end = 0.;   ///< [s]
  double        output_step    = 0.;    ///< [s] between rows of the history; 0: see output_step()
  double        picture_step   = 0.;    ///< [s] between saved states for pictures; 0: none
  StateRequest  states         = {};    ///< kept besides
  bool          events         = true;  ///< located and restarted at; false: gone over, and told afterwards
  bool          force_unstable = false; ///< runs although the method is unstable with this step
  bool          energy         = true;
  bool          allow_large    = false; ///< histories and pictures above 1 GB
};

/// Time between rows [s]: as asked for, or the fixed step, or with a controlled one a two thousandth of the run.
double output_step(const RunOptions &options);

/**
 * What can be told of a run before it is made.
 *
 * @throws std::invalid_argument for parameters out of range, an end before the begin, a step longer than the period of
 * a load, and more than 1 GB of history and pictures (unless allowed), with the size and the way out.
 */
void check_run(const Machine &machine, const RunOptions &options, std::size_t n_signals);

struct SignalSummary
{
  std::string name, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

/// What the integration cost.
struct WorkCounts : IntegrationWork
{
  long chatter = 0; ///< steps in which events were so many that they were gone over
};

struct EnergySummary
{
  double input = 0., stored = 0., dissipated = 0., residual = 0.; ///< [J]
  double exchanged = 0.; ///< [J] that the residual is measured against, see EnergyGuard
};

struct RunResult
{
  std::vector<SignalSummary> signals;
  std::string                method;   ///< name of the method, for people
  std::vector<ModeAccuracy>  accuracy; ///< what it makes of each mode; empty with a controlled step
  /// Rows of history.csv: t, every signal, then energy input, stored, dissipated.
  std::vector<std::string>     columns, units;
  std::vector<double>          rows; ///< row major, columns.size() wide
  std::vector<Event>           events;
  WorkCounts                   work;
  EnergySummary                energy;
  std::vector<double>          picture_times;
  std::vector<Eigen::VectorXd> picture_states; ///< q
  KeptStates                   states;         ///< those asked for
  std::vector<std::string>     warnings;
  double                       wall_s = 0.;
  std::string                  failure; ///< not empty: why it stopped early
  bool                         interrupted = false;
};

/// Finds the forces and accelerations of the start, and nothing more.
/// @throws ConvergenceFailure if there are none; std::invalid_argument if the method cannot treat the machine
void try_start(Machine &machine, const InitialState &initial, const RunOptions &options);

/// Integrates from `initial` to options.end.  A ConvergenceFailure is told in `failure`, with all that was computed up
/// to then; of a machine that does not start, nothing.  `progress` is called now and then with the time reached; `stop`
/// ends the run early.
/// @throws std::invalid_argument as check_run() and StabilityGuard::check(), and if the method cannot treat the
/// machine.
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress = {},
                   const std::atomic<bool> *stop = nullptr);

} // namespace gestell::coupling
