#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"

#include <array>
#include <limits>
#include <vector>

namespace gestell::coupling
{

struct EventOptions
{
  bool   locate = true; ///< false: events are reported after the step, without locating them
  double end    = std::numeric_limits<double>::infinity(); ///< [s] a step that exceeds it is cut there

  /// Sliding speed [m/s, rad/s] below which a motion starts in the sticking state: for a computed initial state with
  /// rounding errors.
  double still = 0.;

  int max_per_step = 20; ///< largest number located within the length of one step; more are chatter
};

/**
 * Drives an integrator from event to event and updates the history of the elements.
 *
 * Between events every law follows its branch, smoothly continued (SecondOrderSystem::follow_history), so that the
 * integrator keeps its order.  After each step the guards (event functions) are evaluated at both ends, inside the
 * step, and at the extremum of parabolas through three of these values, which are refined until the sign of the
 * extremum is known.  The first zero in a guard's direction is located on the dense output, the step is cut there and
 * improved until the guard of the state itself is zero; then the transition is executed and the integration restarted.
 * A guard that is past its zero at the start of a step and remains there, or that depends on the force of a sticking
 * measure, is an event at that start; so is a guard that is past its zero by more than rounding when it is first
 * evaluated, for any step length.
 *
 * Chatter (Zeno): after max_per_step events within one step's length, one step is made in which the laws follow the
 * motion and events are only reported.
 */
class EventDriver
{
public:
  /// @param observers  receive steps, guards and events, in their order; must outlive the driver
  EventDriver(SecondOrderSystem &system, TimeIntegrator &integrator, const EventOptions &options,
              const std::vector<RunObserver *> &observers = none());

  /// Initialises history and integration.
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

  /// One step of the integrator, or the part of it up to its first event.  The history is up to date afterwards.
  /// @throws ConvergenceFailure
  void advance();

  const std::vector<Event> &events() const { return events_; }
  long                      chattering_steps() const { return chattering_; }
  /// [s] total duration of those steps.
  double chattering_time() const { return chattering_time_; }

  /// The complete state for later events, including the history of the elements and the state of the integrator.
  void exchange(StateArchive &archive);

private:
  static const std::vector<RunObserver *> &none();

  void hold_what_is_still();

  struct Crossing
  {
    int    guard = -1;
    double t     = 0.; ///< just past the zero
    double slope = 0.; ///< of the guard there
  };

  /// A guard at an instant, with its sign such that it rises through zero.
  struct Look
  {
    double t, g;
  };

  bool   first_crossing(Crossing &crossing);
  bool   first_crossing_between(double begin, double end, Crossing &crossing);
  bool   is_due_at_begin(int guard, double here, double next);
  bool   begins_past(int guard, double here);
  bool   looks_at_held_force(int guard);
  bool   turns_above_zero(int guard, Look a, Look b, Look c, Look &low, Look &top);
  bool   far_from_zero() const;
  void   locate(int guard, double low, double g_low, double high, double g_high, Crossing &crossing);
  double value_at(int guard, double t);
  double sign(int guard) const { return system_.events().crossing(guard) == GuardCrossing::rising ? 1. : -1.; }
  void   take(const Crossing &crossing);
  void   step_over();
  bool   cut_at_end();
  void   observe();
  void   tell_events();
  void   make_room();

  static constexpr int n_inside = 3; ///< samples inside a step

  SecondOrderSystem                        &system_;
  TimeIntegrator                           &integrator_;
  EventOptions                              options_;
  EventDetection                            detection_;
  std::vector<Event>                        events_;
  LocalState                                before_, between_;
  std::array<Eigen::VectorXd, n_inside + 2> g_; ///< guards at the samples of the step
  Eigen::VectorXd                           probe_;
  double                                    window_begin_ = 0., length_ = 0.; ///< of the step for the count of events
  bool                                      anew_ = true; ///< after a start or a transition, before a step
  std::vector<std::string>                  watched_;     ///< owners of guards that have been evaluated before
  int                                       in_window_       = 0;
  long                                      chattering_      = 0;
  double                                    chattering_time_ = 0.;
  const std::vector<RunObserver *>         &observers_;
  std::size_t                               reported_ = 0; ///< number of events
};

} // namespace gestell::coupling
