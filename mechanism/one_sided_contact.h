#pragma once

#include "mechanism/branches.h"

namespace gestell::mechanism
{

/**
 * Branches of a one-sided contact, closed or open, determined by the motion only.
 *
 * closes() is the condition of the closed branch; the only guard rises through zero where an open contact closes and
 * falls through zero where a closed one opens.
 */
class OneSidedContact : public Branches
{
public:
  /// history: 1 closed, 0 open.
  int  n_history() const final { return 1; }
  void start(const LocalMotion &motion, double *history) const final
  {
    history[0] = closes(motion.u[0], motion.v[0]) ? 1. : 0.;
  }

  int                n_guards(const double *) const final { return 1; }
  std::vector<Guard> guards(const double *history) const final
  {
    return {{event(!is_closed(history)), is_closed(history) ? Crossing::falling : Crossing::rising}};
  }
  void transition(int, const LocalMotion &, double *history) const final { history[0] = 1. - history[0]; }

protected:
  /// Whether the contact is closed by the motion itself.
  virtual bool closes(double u, double v) const = 0;
  /// Name of the event that closes or opens it.
  virtual std::string event(bool closing) const = 0;

  static bool is_closed(const double *history) { return history[0] != 0.; }
};

} // namespace gestell::mechanism
