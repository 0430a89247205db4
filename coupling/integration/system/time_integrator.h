#pragma once

#include "coupling/integration/system/second_order_system.h"

namespace gestell::coupling
{

/// The motion of the whole system at an instant.
struct Instant
{
  double          t = 0.;
  Eigen::VectorXd q, v; // [n]
  LocalState      local;
};

/// Cost of the integration, independent of the computer.
struct IntegrationWork
{
  long steps = 0, rejected = 0, newton = 0, factorisations = 0, solves = 0;
  long evaluations = 0; ///< of the forces of all elements, with or without derivatives
};

/**
 * Integrates a SecondOrderSystem in time in steps of its own choice.
 *
 * It never changes the history of the system's elements: its driver accepts the instant (SecondOrderSystem::accept) and
 * executes the transitions of events (EventDriver does both).
 *
 *     begin(t, q, q')                       anew, with a clean slate
 *     advance()                             one step
 *     interpolate(t, ...)                   dense output inside the last step
 *     cut(t)                                the last step ends at t instead: where an event lies
 *     restart()                             forces changed here (an event): nothing from before is used again
 */
class TimeIntegrator
{
public:
  virtual ~TimeIntegrator() = default;

  /// Starts at t with q, v [n]; the history of the elements must have been started.
  virtual void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) = 0;

  /// Makes one step.  A step whose equation is not solved is never accepted: it is divided, or fails.
  /// @throws ConvergenceFailure naming time, coordinate and residual; instant() is then the last accepted one.
  virtual void advance() = 0;

  /// Measures and forces at the present instant; cheap.
  virtual const LocalState &local() const = 0;
  double                    time() const { return local().t; }

  /// The whole motion at the present instant; computed on request.
  virtual const Instant &instant() const = 0;

  /// Start of the last step [s]; equal to time() after begin(), cut() at its start and restart().
  virtual double step_begin() const = 0;

  /// Number of equal parts of the last step in each of which the phase of the measures advances by a few rad at most,
  /// so that few samples suffice.  Default: 1, for steps that are short compared with the motion.
  virtual int parts_of_step() const { return 1; }

  /// Dense output at t in [step_begin(), time()], at least of third order: u, v of the measures; a and p as far as the
  /// method provides them.
  virtual void interpolate(double t, LocalState &state) const = 0;
  /// q, v [n] at t in [step_begin(), time()].
  virtual void interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const = 0;

  /// q, v of the given coordinates at t in [step_begin(), time()]; the others are undefined: for signals in every step.
  virtual void motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const
  {
    if (t != time())
    {
      interpolate(t, q, v);
      return;
    }
    const Instant &now = instant();
    for (const int i : coordinates)
    {
      q[i] = now.q[i];
      v[i] = now.v[i];
    }
  }

  /// Makes the last step end at t in (step_begin(), time()] instead.  Methods that can repeat the step to t, which
  /// makes the state there slightly more accurate than interpolate(); it may be cut again anywhere in the original
  /// step.  A cut at step_begin() rejects the step; if the equation of the repeated step is not solved, the step is
  /// also rejected, and time() is then step_begin().
  virtual void cut(double t) = 0;

  /// Forces change their branch at the present instant: past points are discarded, order and state are kept.
  virtual void restart() = 0;

  virtual const IntegrationWork &work() const = 0;
};

} // namespace gestell::coupling
