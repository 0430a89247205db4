#pragma once

#include "coupling/integration/events/event_detection.h"
#include "coupling/integration/events/finding.h"

namespace gestell::coupling
{

class StateArchive;

void exchange(StateArchive &archive, Event &event);

/// Observes a motion step by step.  step() and verify() may end it by a ConvergenceFailure.
class RunObserver
{
public:
  virtual ~RunObserver() = default;

  virtual void begin() {} ///< the integrator stands at the start
  /// A step was made, or part of one, and its dense output and the history that holds on it are there: nothing of it is
  /// accepted yet, and the transition at its end is still to come.
  virtual void step() {}
  /// The zero of a guard was located at the end of the step, which was cut there; its transition follows.
  virtual void guard(int) {}
  /// A transition was made and the integration is ready to go on from there; in a step without located events, at its
  /// end.
  virtual void event(const Event &) {}
  /// @throws ConvergenceFailure if the observed history is not a motion of the machine; for runs with unknown end
  virtual void verify() const {}
  virtual void finish(RunOutcome &) {} ///< at the end, with what earlier observers have found
  virtual void exchange(StateArchive &) {}
};

} // namespace gestell::coupling
