#pragma once

#include "coupling/integration/events/motion.h"
#include "coupling/integration/step/load_breakpoints.h"
#include "coupling/machine/accelerations.h"
#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/resumable_steps.h"
#include "coupling/simulation/run_result.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// State from which a run continues: q, v [n] and the history of all elements.
struct SteppedState
{
  double          t = 0.;
  Eigen::VectorXd q, v, history;
  std::string     ended{};  ///< statement of the switch that ended the run at t; empty: it continues
  std::string     checks{}; ///< state of the checks; empty: they start from scratch
};

/**
 * A run in pieces, as required by programs coupled with it, with the run's own method, steps and events.  Between two
 * pieces loads may be changed from outside.
 *
 * Steps do not end at the end of a piece; the values there follow from the dense output, as for rows of a history.  As
 * long as no load changes, they are therefore those of simulate(), even for short pieces.  If a load or its rate jumps,
 * the integration restarts at the end of the piece, and the part of the step beyond it is discarded.
 *
 * It has the same checks as simulate(); they ignore discarded parts of steps.
 */
class SteppedRun : private RunObserver
{
public:
  /// Starts the run.  The machine must outlive it.
  /// @throws std::invalid_argument as check_run() and StabilityGuard::check() do; ConvergenceFailure if the machine
  /// does not start
  SteppedRun(Machine &machine, const InitialState &initial, const RunOptions &options, std::vector<Signal> signals);
  SteppedRun(const SteppedRun &)            = delete;
  SteppedRun &operator=(const SteppedRun &) = delete;

  double time() const { return now_; } ///< [s]
  /// Whether t is the present instant: within 1e-6 of a step.
  bool is_now(double t) const;

  /// Integrates to t > time(), or until a switch ends the run.
  /// @throws ConvergenceFailure, also from a check; time() is then the last instant reached
  void go_on_to(double t);
  /// Statement of the switch that ended the run at time(); empty: it continues.
  std::string ended() const { return now_ < end_ ? "" : ended_; }
  /// A load or its rate has jumped at this instant.
  void load_jumped();

  /// @throws ConvergenceFailure if the result so far is not physical.  go_on_to() calls it at the end of the scene's
  ///   run, and whenever the number of steps has doubled.
  void verify();
  /// Collects the findings of the checks up to time(); afterwards the run can only be continued from a state.
  /// @param failure  reason for the end; empty: none
  /// @return why the result is not physical, if detected only now
  std::string finish(const std::string &failure = "", const std::string &id = "");

  const std::vector<double> &values();        ///< of the signals at time()
  std::vector<Event>         take_events();   ///< up to time(), since the last call
  std::vector<Finding>       take_findings(); ///< of the start and of finish(), since the last call

  /// The present state.  The run itself then continues as if restored from it: multistep formulas restart.
  SteppedState state();
  void         restore(const SteppedState &state);

private:
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);
  void event(const Event &event) override;
  void step() override;
  void move_to(double t);
  void look_into_step(double t, const Eigen::VectorXd &history, std::string checks);
  void look_behind_step(double t, Eigen::VectorXd on_step);
  bool stays_in_step(double t);
  void end_in_step();
  void evaluate(const LocalState &local);

  std::string checks_now();
  std::string checks_at(double t);
  void        restore_checks(const std::string &state);

  Machine                     &machine_;
  RunOptions                   options_;
  MethodOptions                method_;
  std::vector<Signal>          signals_;
  Motion                       motion_;
  ResumableSteps              &steps_; ///< inside the integrator
  RunOutcome                   outcome_;
  std::vector<int>             coordinates_;   ///< that signals read
  std::optional<Accelerations> accelerations_; ///< if a signal reads any
  LocalState                   inside_;        ///< scratch
  Eigen::VectorXd              q_, v_, a_;
  std::vector<double>          values_;
  LoadedMotion                 loaded_;                         ///< with the future of the scene's run
  double                       now_ = 0., target_ = 0., slack_; ///< [s]
  bool                         ahead_ = false;                  ///< the last step went beyond now_
  SteppedState                 there_;                          ///< state at now_ in this case
  Eigen::VectorXd              on_step_;                        ///< valid history in the last step
  std::vector<Event>           events_;                         ///< not taken yet
  std::string                  ended_;
  double                       end_ = 0.; ///< [s] where it ended

  std::vector<std::unique_ptr<RunObserver>> checks_;
  std::string                               checks_new_;   ///< initial state of the checks
  std::string                               checks_begin_; ///< state of the checks before the step beyond now_
  double                                    still_;        ///< initial sliding speed, see EventOptions
  long                                      next_look_;    ///< number of steps at which the motion is verified
};

} // namespace gestell::coupling
