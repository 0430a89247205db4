#pragma once

#include "coupling/integration/events/event_detection.h"
#include "coupling/integration/events/finding.h"

namespace gestell::coupling
{

class StateArchive;

void exchange(StateArchive &archive, Event &event);

/// Observes a motion step by step.  step() and verify() can end it with a ConvergenceFailure.
class RunObserver
{
public:
  virtual ~RunObserver() = default;

  virtual void begin() {} ///< the integrator is at the start
  /// Called after a step, or part of one: its dense output and the history that is valid in it are available.  The step
  /// is not yet accepted, and the transition at its end follows.
  virtual void step() {}
  /// The zero of a guard was located at the end of the step, which was cut there; its transition follows.
  virtual void guard(int) {}
  /// Called after a transition, when the integration is ready to continue; in a step without located events, at its
  /// end.
  virtual void event(const Event &) {}
  /// @throws ConvergenceFailure if the observed history is not a motion of the machine; for runs with unknown end
  virtual void verify() const {}
  virtual void finish(RunOutcome &) {} ///< at the end, with the findings of earlier observers
  virtual void exchange(StateArchive &) {}
};

} // namespace gestell::coupling
