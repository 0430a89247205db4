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
  double end    = std::numeric_limits<double>::infinity(); ///< [s] a step that goes beyond is cut there

  /// Sliding speed [m/s, rad/s] up to which a motion begins sticking: that of a start that was computed, and is
  /// rounded.
  double still = 0.;

  int max_per_step = 20; ///< located within the length of one step; more is chatter
};

/**
 * Drives an integrator from event to event and keeps the history of the elements.
 *
 * Between events every law follows its branch, smoothly continued (SecondOrderSystem::follow_history), so that the
 * integrator keeps its order.  After each step the guards are looked at, at both ends, inside it, and where parabolas
 * through three of these values turn, drawn closer until they tell on which side of zero the guard turns; the first
 * zero in a guard's direction is located on the dense output, the step is cut there, improved until the guard of the
 * state itself is zero, the transition is taken and the integration restarted.  A guard that is past its zero at the
 * begin of a step and stays so, or that looks at the force that holds a measure, is an event at that begin; so is one
 * that is past it by more than rounding where it is looked at for the first time, however long the step.
 *
 * Chatter (Zeno): after max_per_step events within one step's length, one step is taken with the laws following the
 * motion and events only told.
 */
class EventDriver
{
public:
  /// @param observers  receive steps, guards and events, in their order; must outlive the driver
  EventDriver(SecondOrderSystem &system, TimeIntegrator &integrator, const EventOptions &options,
              const std::vector<RunObserver *> &observers = none());

  /// Starts history and integration.
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

  /// One step of the integrator, or the part of it up to its first event.  The history is up to date afterwards.
  /// @throws ConvergenceFailure
  void advance();

  const std::vector<Event> &events() const { return events_; }
  long                      chattering_steps() const { return chattering_; }
  /// [s] that those steps took.
  double chattering_time() const { return chattering_time_; }

  /// All that the events to come depend on, history of the elements and state of the integrator too.
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

  /// A guard at an instant, turned so that it rises through its zero.
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
  double                                    window_begin_ = 0., length_ = 0.; ///< of the step events are counted in
  bool                                      anew_ = true; ///< behind a begin or a transition, before a step
  std::vector<std::string>                  watched_;     ///< whose guards have been looked at before
  int                                       in_window_       = 0;
  long                                      chattering_      = 0;
  double                                    chattering_time_ = 0.;
  const std::vector<RunObserver *>         &observers_;
  std::size_t                               reported_ = 0; ///< events
};

} // namespace gestell::coupling
