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

/// From which a run goes on: q, v [n] and the history of all elements.
struct SteppedState
{
  double          t = 0.;
  Eigen::VectorXd q, v, history;
  std::string     ended{};  ///< statement of the switch that ended the run at t; empty: it goes on
  std::string     checks{}; ///< state of the checks; empty: they start afresh
};

/**
 * A run that goes on piece by piece, as others that are coupled with it demand, with the run's own method, steps and
 * events.  Between two pieces loads may change from outside.
 *
 * Steps go over the end of a piece as they go over a row of a history: what holds there is told by the dense output.
 * As long as no load changes, they are therefore those of simulate(), however short the pieces are.  Where a load jumps
 * or bends, the integration begins anew from the end of the piece, and what was stepped beyond is forgotten.
 *
 * It is checked as simulate() checks a run; what was stepped beyond and forgotten counts for no check.
 */
class SteppedRun : private RunObserver
{
public:
  /// Starts.  The machine must outlive it.
  /// @throws std::invalid_argument as check_run() and StabilityGuard::check(); ConvergenceFailure if the machine does
  /// not start
  SteppedRun(Machine &machine, const InitialState &initial, const RunOptions &options, std::vector<Signal> signals);
  SteppedRun(const SteppedRun &)            = delete;
  SteppedRun &operator=(const SteppedRun &) = delete;

  double time() const { return now_; } ///< [s]
  /// An instant that is no other than the present one: 1e-6 of a step from it.
  bool is_now(double t) const;

  /// Integrates to t > time(), or until a switch ends the run.
  /// @throws ConvergenceFailure, that of a check too; time() is then the last instant reached
  void go_on_to(double t);
  /// Statement of the switch that ended the run at time(); empty: it goes on.
  std::string ended() const { return now_ < end_ ? "" : ended_; }
  /// A load is another one from now on, in value or rate.
  void load_jumped();

  /// @throws ConvergenceFailure if the result so far is not a motion.  go_on_to() asks by itself where the run of the
  /// scene would end, and when the steps have become twice as many.
  void verify();
  /// Collects the findings of the checks up to time(); the run continues from a state only.
  /// @param failure  that ended it; empty: none
  /// @return         why it is not a motion, if detected only now
  std::string finish(const std::string &failure = "", const std::string &id = "");

  const std::vector<double> &values();        ///< of the signals at time()
  std::vector<Event>         take_events();   ///< up to time(), since they were taken last
  std::vector<Finding>       take_findings(); ///< of the start and of finish(), since they were taken last

  /// The present state; the run itself continues from it like a restored one: multistep formulas restart.
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
  ResumableSteps              &steps_; ///< of it
  RunOutcome                   outcome_;
  std::vector<int>             coordinates_;   ///< that signals read
  std::optional<Accelerations> accelerations_; ///< if a signal reads any
  LocalState                   inside_;        ///< scratch
  Eigen::VectorXd              q_, v_, a_;
  std::vector<double>          values_;
  LoadedMotion                 loaded_;                         ///< by what is to come in the scene's run
  double                       now_ = 0., target_ = 0., slack_; ///< [s]
  bool                         ahead_ = false;                  ///< the last step went beyond now_
  SteppedState                 there_;                          ///< at now_, if it did
  Eigen::VectorXd              on_step_;                        ///< history that held on the last step
  std::vector<Event>           events_;                         ///< not taken yet
  std::string                  ended_;
  double                       end_ = 0.; ///< [s] where it ended

  std::vector<std::unique_ptr<RunObserver>> checks_;
  std::string                               checks_new_;   ///< at the start
  std::string                               checks_begin_; ///< what they knew before the step that went beyond now_
  double                                    still_;        ///< sliding speed of the start, see EventOptions
  long                                      next_look_;    ///< number of steps at which the motion is verified
};

} // namespace gestell::coupling
