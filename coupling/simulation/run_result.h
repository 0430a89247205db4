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

/// A request for the maximum or minimum of a signal.
struct SignalExtreme
{
  int  signal  = -1; ///< its index
  bool largest = true;
};

/// Requested states of a run for later computations, for example of stresses.
struct StateRequest
{
  double                     step = 0.; ///< [s] of a grid that starts with the run; 0: none
  std::vector<double>        at;        ///< [s] instants, ascending
  std::vector<SignalExtreme> extremes;
  std::vector<SignalExtreme> around; ///< extremes around which states are kept, see StatesAround

  /// Whether there is a request other than `around`.
  bool empty() const { return !(step > 0.) && at.empty() && extremes.empty(); }
};

struct KeptState
{
  double          t = 0.;
  Eigen::VectorXd q;   ///< empty: the run did not reach it
  Eigen::VectorXd v{}; ///< only for extremes and the states around them
  Eigen::VectorXd p{}; ///< as v: forces on the measures, see RunResult::picture_forces
};

struct KeptStates
{
  std::vector<KeptState>              grid, at, extremes; ///< at, extremes: in the order of the request
  std::vector<std::vector<KeptState>> around;             ///< in the order of the request, each ascending in time
};

struct RunOptions
{
  MethodOptions method;
  double        begin = 0., end = 0.;   ///< [s]
  double        output_step    = 0.;    ///< [s] between rows of the history; 0: see output_step()
  double        picture_step   = 0.;    ///< [s] between saved states for pictures, denser after events; 0: none
  StateRequest  states         = {};    ///< additional states
  bool          events         = true;  ///< located, with a restart; false: not located, reported after the step
  bool          force_unstable = false; ///< run even if the method is unstable with this step
  bool          energy         = true;
  bool          allow_large    = false; ///< histories and pictures above 1 GB
  /// [s] Extremes of signals start there; before the beginning: over the whole run.
  double from = -std::numeric_limits<double>::infinity();
};

/// Time between rows [s]: as requested, or the fixed step, or with a controlled step 1/2000 of the run.
double output_step(const RunOptions &options);

struct SignalSummary
{
  std::string name, unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

/// Signals at a located event, by index: just before the first event of that instant, and after the last one.
struct EventValues
{
  double              t = 0.;        ///< [s] at which they are valid; differs from the event if that was not located
  std::vector<double> before, after; ///< empty: none
  std::vector<double> rate;          ///< [1/s] before; nan: no step since the last restart
};

/// Cost of the integration.
struct WorkCounts : IntegrationWork
{
  long chatter = 0; ///< steps with too many events to locate
};

struct EnergySummary
{
  double input = 0., stored = 0., dissipated = 0., residual = 0.; ///< [J]
  double exchanged = 0.; ///< [J] reference value for the residual, see EnergyGuard
};

/// Results of a run; its findings are those of the checks before, during and after it.
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
  std::vector<Eigen::VectorXd> picture_velocities; ///< q' at the same times; empty if unknown
  std::vector<Eigen::VectorXd> picture_forces;     ///< p [n_u] on the measures of all elements; empty if unknown
  KeptStates                   states;             ///< as requested
  Eigen::VectorXd              end_state;          ///< q at the end
  double                       wall_s = 0.;
};

} // namespace gestell::coupling
