#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Dry friction after Coulomb that truly sticks, against a counterface (belt) of speed v_b.
 *
 * Measure u [m or rad]; generalised force p [N or N m], three branches:
 *
 *     slip forward      u' > v_b      p = -R
 *     slip backward     u' < v_b      p = +R
 *     stick             u' = v_b      p is the force that holds it there, |p| <= R0
 *
 * Sticking ends where the holding force reaches R0: p = -R0 (pulled forward) lets go forward, p = +R0 backward.  It
 * begins where u' - v_b comes to zero, whatever the load; if that is too large to hold, a guard of the new branch is
 * past zero from its start and lets go at the same instant.  So a slide turns back by two events, stick and slip.  A
 * motion that starts with u' = v_b starts sticking.
 *
 * The element needs an integrator that locates events.  force() of a motion by itself (by_history = false) is
 * -R sign(u' - v_b), zero at u' = v_b; by history it is zero in stick, where holds() says that it is not asked.
 *
 * Against ground (v_b = 0) its work is dissipated; a belt is a drive: its work counts as input, what the sliding takes
 * already deducted.  For natural frequencies it has no stiffness.
 *
 * Source: docs/theory/elements.md.
 */
class CoulombFriction : public DifferentiableElement<CoulombFriction, 1>
{
public:
  struct Parameters
  {
    double kinetic_force = 0.; ///< R [N or N m], >= 0
    double static_force  = 0.; ///< R0 [N or N m], >= R
    double belt_speed    = 0.; ///< v_b [m/s or rad/s]
  };

  explicit CoulombFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Branch branch = m.by_history ? branch_of(history) : branch_at(value(m.v[0]));
    p[0]                = Number(-branch * parameters_.kinetic_force);
  }

  /// history: active branch.
  int  n_history() const override { return 1; }
  void start(const LocalMotion &motion, double *history) const override;
  bool holds(const double *history, double &rate) const override;
  Work work() const override { return parameters_.belt_speed == 0. ? Work::dissipated : Work::input; }

  int                n_guards(const double *history) const override { return branch_of(history) == stick ? 2 : 1; }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  /// The sign of the sliding speed u' - v_b.
  enum Branch
  {
    slip_backward = -1,
    stick         = 0,
    slip_forward  = 1
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[0])); }
  Branch        branch_at(double v) const
  {
    return v > parameters_.belt_speed ? slip_forward : v < parameters_.belt_speed ? slip_backward : stick;
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
