#pragma once

#include "mechanism/local_motion.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

enum class Crossing
{
  rising,
  falling
};

/// A switching function of the active branch; the transition is at its zero crossing in direction `crossing`.
struct Guard
{
  std::string kind; ///< name of the transition, e.g. "tool_contact"
  Crossing    crossing;
};

/**
 * Facet of an element whose law has branches or hysteresis.
 *
 * Memory (largest penetration, active branch, sliding state) is stored outside, in n_history() numbers per element that
 * the system owns, saves and restores as one vector. accept() and transition() change it, for accepted motion only.
 *
 * Events.  Inside a branch the law is smooth; guard_values() are the switching functions of the active branch, open on
 * the side from which they may cross: a rising guard while negative, a falling one while positive.  Right after a
 * transition the guard of the reverse transition is zero within rounding, and the motion moves it to its open side: a
 * guard past zero at the beginning of a step but open at its end is not due.  One that is past zero at both (play of
 * width zero) is due at the beginning: its transition is taken at the same instant as the one before.  Guards of a
 * branch that holds() depend on a force that jumps at the transition: they are evaluated with the new force before the
 * next step, and if past zero their transition is taken at once.
 */
class Branches
{
public:
  virtual int n_history() const = 0;

  /// Sets the history for a motion that starts here.
  virtual void start(const LocalMotion &motion, double *history) const = 0;
  /// The same for an element that is switched on again: earlier commands remain in effect.
  virtual void resume(const LocalMotion &motion, double *history) const { start(motion, history); }
  virtual void accept(const LocalMotion &, double *history) const { (void)history; }

  /// true: in the branch named by the history the element's single measure sticks at u' = rate and its force p is the
  /// unknown, a constraint force that the system finds; force() and tangent() are then not consulted for p, and
  /// guard_values() and quantity() read motion.p.
  virtual bool holds(const double *history, double &rate) const { return (void)history, (void)rate, false; }

  /// Switching functions of the active branch by `history`.
  virtual std::vector<Guard> guards(const double *history) const                                             = 0;
  virtual int                n_guards(const double *history) const                                           = 0;
  virtual void               guard_values(const LocalMotion &motion, const double *history, double *g) const = 0;
  /// Executes the transition of guard i at the motion where it crossed zero.
  virtual void transition(int i, const LocalMotion &motion, double *history) const = 0;

protected:
  ~Branches() = default;
};

} // namespace gestell::mechanism
