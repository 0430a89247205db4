#pragma once

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/step/loads_to_come.h"
#include "coupling/machine/accelerations.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/communicated_steps.h"
#include "coupling/simulation/run_result.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// From which a motion goes on: q, v [n] and the history of all elements.
struct MotionState
{
  double          t = 0.;
  Eigen::VectorXd q, v, history;
};

/**
 * A run that goes on piece by piece, as others that are coupled with it demand, with the run's own method and steps;
 * events are located and passed inside the pieces.  Between two pieces loads may change from outside.
 *
 * Where pieces are whole numbers of fixed steps and no load jumps, the steps are those of simulate().  A piece that
 * ends inside a step cuts it there, and a load that jumps restarts the integration, as an event does.
 */
class SteppedRun
{
public:
  /// Starts.  The machine must outlive it.
  /// @throws std::invalid_argument as check_run() and StabilityGuard::check(); ConvergenceFailure if the machine does
  /// not start
  SteppedRun(Machine &machine, const InitialState &initial, const RunOptions &options, std::vector<Signal> signals);
  SteppedRun(const SteppedRun &)            = delete;
  SteppedRun &operator=(const SteppedRun &) = delete;

  double time() const { return steps_.time(); } ///< [s]
  /// An instant that is no other than the present one: 1e-9 of a step from it.
  bool is_now(double t) const;

  /// Integrates to t > time(), or until a switch ends the run.
  /// @throws ConvergenceFailure; time() is then the last instant reached
  void go_on_to(double t);
  /// Statement of the switch that ended the run; empty: it goes on.
  const std::string &ended() const { return ended_; }
  /// A load is another one from now on, in value or rate.
  void load_jumped();

  /// The signals at time().
  const std::vector<double>     &values();
  const std::vector<Signal>     &signals() const { return signals_; }
  const std::vector<Event>      &events() const { return driver_.events(); }
  const std::vector<std::string> warnings() const { return warnings_; } ///< of the method, at the start

  /// The present state; the run itself goes on from it as one that restores it does: multistep formulas start anew.
  MotionState state();
  void        restore(const MotionState &state);

private:
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

  Machine                     &machine_;
  RunOptions                   options_;
  MethodOptions                method_;
  std::vector<Signal>          signals_;
  std::vector<std::string>     warnings_;
  CommunicatedSteps            steps_;
  EventDriver                  driver_;
  std::vector<int>             coordinates_;   ///< that signals read
  std::optional<Accelerations> accelerations_; ///< if a signal reads any
  Eigen::VectorXd              q_, v_, a_;
  std::vector<double>          values_;
  LoadedMotion                 loaded_; ///< by what is to come in the scene's run
  std::string                  ended_;
};

} // namespace gestell::coupling
