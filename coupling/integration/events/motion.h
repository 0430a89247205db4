#pragma once

#include "coupling/integration/events/event_driver.h"

#include <memory>
#include <optional>

namespace gestell::coupling
{

/**
 * A motion of a system in time: the integrator, the event driver, and observers in their order.
 *
 *     Motion motion(system, make_integrator(system, method));
 *     motion.watch(observer);
 *     motion.begin(t, q, v, {locate, end});
 *     motion.to_end();
 */
class Motion
{
public:
  /// The system must outlive it.
  Motion(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> integrator);
  Motion(const Motion &)            = delete;
  Motion &operator=(const Motion &) = delete;

  /// Adds an observer, which must outlive the motion.  It is called for all later steps, and at once for a past start.
  void watch(RunObserver &observer);

  /// Starts, or restarts.
  /// @throws ConvergenceFailure
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const EventOptions &events);
  /// One step, or the part of it up to its first event.
  /// @throws ConvergenceFailure, also that of an observer
  void advance() { driver_->advance(); }
  bool at_end() const { return !(integrator_->time() < finish_); }
  /// Steps to the end while `goes_on` returns true after each step.
  /// @throws as advance() does
  template <class GoesOn>
  void to_end(const GoesOn &goes_on)
  {
    while (!at_end())
    {
      advance();
      if (!goes_on())
        return;
    }
  }
  void to_end()
  {
    to_end([] { return true; });
  }

  double                time() const { return integrator_->time(); }
  TimeIntegrator       &integrator() { return *integrator_; }
  const TimeIntegrator &integrator() const { return *integrator_; }
  const EventDriver    &driver() const { return *driver_; } ///< events and chatter since the last begin()
  long   chattering_steps() const { return chattering_ + driver_->chattering_steps(); }    ///< of all starts
  double chattering_time() const { return chattering_time_ + driver_->chattering_time(); } ///< [s] of all starts

  /// State of events, integrator and observers.
  void exchange(StateArchive &archive);

private:
  SecondOrderSystem              &system_;
  std::unique_ptr<TimeIntegrator> integrator_;
  std::vector<RunObserver *>      observers_;
  std::optional<EventDriver>      driver_;
  double                          finish_          = 0.; ///< [s] the end minus rounding
  long                            chattering_      = 0;  ///< before the last start
  double                          chattering_time_ = 0.;
};

} // namespace gestell::coupling
