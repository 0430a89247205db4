#pragma once

#include "coupling/integration/events/event_detection.h"
#include "coupling/integration/events/finding.h"
#include "coupling/integration/method_options.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/simulation/checks/stability_guard.h"

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Where a signal is largest or smallest.
struct SignalExtreme
{
  int  signal  = -1; ///< number
  bool largest = true;
};

/// States of a run that are kept for what is computed from them afterwards, stresses for instance.
struct StateRequest
{
  double                     step = 0.; ///< [s] of a grid from the beginning of the run; 0: none
  std::vector<double>        at;        ///< [s] instants, ascending
  std::vector<SignalExtreme> extremes;
  std::vector<SignalExtreme> around; ///< whose surroundings are kept, see StatesAround

  /// What is asked for besides `around`.
  bool empty() const { return !(step > 0.) && at.empty() && extremes.empty(); }
};

struct KeptState
{
  double          t = 0.;
  Eigen::VectorXd q;   ///< empty: the run did not come so far
  Eigen::VectorXd v{}; ///< of extremes and what is around them alone
  Eigen::VectorXd p{}; ///< likewise: forces on the measures, see RunResult::picture_forces
};

struct KeptStates
{
  std::vector<KeptState>              grid, at, extremes; ///< the last two as in the request
  std::vector<std::vector<KeptState>> around;             ///< as in the request, each ascending in time
};

struct RunOptions
{
  MethodOptions method;
  double        begin = 0., end = 0.;   ///< [s]
  double        output_step    = 0.;    ///< [s] between rows of the history; 0: see output_step()
  double        picture_step   = 0.;    ///< [s] between saved states for pictures, closer behind events; 0: none
  StateRequest  states         = {};    ///< kept besides
  bool          events         = true;  ///< located, with a restart; false: not located, reported after the step
  bool          force_unstable = false; ///< runs although the method is unstable with this step
  bool          energy         = true;
  bool          allow_large    = false; ///< histories and pictures above 1 GB
  /// [s] Extremes of signals start there; before the beginning: over the whole run.
  double from = -std::numeric_limits<double>::infinity();
};

/// Time between rows [s]: as asked for, or the fixed step, or with a controlled one a two thousandth of the run.
double output_step(const RunOptions &options);

struct SignalSummary
{
  std::string name, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

/// Signals at a located event, by number: just before the first event of that instant, and after the last one.
struct EventValues
{
  double              t = 0.;        ///< [s] where they are valid: not at an event that was not located
  std::vector<double> before, after; ///< empty: none
  std::vector<double> rate;          ///< [1/s] before; nan: no step was made since the motion restarted
};

/// What the integration cost.
struct WorkCounts : IntegrationWork
{
  long chatter = 0; ///< steps with too many events to locate
};

struct EnergySummary
{
  double input = 0., stored = 0., dissipated = 0., residual = 0.; ///< [J]
  double exchanged = 0.; ///< [J] that the residual is measured against, see EnergyGuard
};

/// What a run gave; its findings are those of checks before, in and after it.
struct RunResult : RunOutcome
{
  std::vector<SignalSummary> signals;
  double                     from = -std::numeric_limits<double>::infinity(); ///< as in RunOptions
  std::string                method;                                          ///< name of the method, for people
  std::vector<ModeAccuracy> accuracy; ///< numerical damping and period error of each mode; empty with a controlled step
  /// Rows of history.csv: t, every signal, then energy input, stored, dissipated.
  std::vector<std::string>     columns, units;
  std::vector<double>          rows; ///< row major, columns.size() wide
  std::vector<Event>           events;
  std::vector<EventValues>     event_values; ///< of the first thousand events
  WorkCounts                   work;
  EnergySummary                energy;
  std::vector<double>          picture_times;
  std::vector<Eigen::VectorXd> picture_states;     ///< q
  std::vector<Eigen::VectorXd> picture_velocities; ///< q' at the same times; empty where they are not known
  std::vector<Eigen::VectorXd> picture_forces;     ///< p [n_u] on the measures of all elements; empty where not known
  KeptStates                   states;             ///< those asked for
  Eigen::VectorXd              end_state;          ///< q at the end
  double                       wall_s = 0.;
};

} // namespace gestell::coupling
