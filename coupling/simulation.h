#pragma once

#include "coupling/machine.h"
#include "coupling/steady_start.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct RunOptions
{
  int    order = 2;                       ///< BDF order
  double begin = 0., end = 0., step = 0.; ///< [s]
  double output_step      = 0.;           ///< [s] between rows of the history; 0: every step
  double picture_step     = 0.;           ///< [s] between saved states for pictures; 0: none
  int    max_halvings     = 10;           ///< of the step when Newton fails
  double newton_tolerance = 1e-10;        ///< relative to the scale of each measure
  bool   energy           = true;
};

struct SignalSummary
{
  std::string name, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

struct EventRecord
{
  double      t;
  std::string name, kind;
};

struct WorkCounts
{
  long steps = 0, rejected = 0, newton = 0, factorisations = 0, solves = 0;
};

struct EnergySummary
{
  double input = 0., stored = 0., dissipated = 0., residual = 0.; ///< [J]
};

struct RunResult
{
  std::vector<SignalSummary> signals;
  /// Rows of history.csv: t, every signal, then energy input, stored, dissipated.
  std::vector<std::string>     columns, units;
  std::vector<double>          rows; ///< row major, columns.size() wide
  std::vector<EventRecord>     events;
  WorkCounts                   work;
  EnergySummary                energy;
  std::vector<double>          picture_times;
  std::vector<Eigen::VectorXd> picture_states; ///< q
  std::vector<std::string>     warnings;
  double                       wall_s = 0.;
  std::string                  failure; ///< not empty: why it stopped early
  bool                         interrupted = false;
};

/// Integrates from `initial` to options.end.  Never throws ConvergenceFailure: it is told in `failure`, with all that
/// was computed up to then.  `progress` is called now and then with the time reached; `stop` ends the run early.
RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress = {},
                   const std::atomic<bool> *stop = nullptr);

} // namespace gestell::coupling
