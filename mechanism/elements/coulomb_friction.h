#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/joint_load.h"
#include "mechanism/stribeck.h"

#include <optional>

namespace gestell::mechanism
{

/**
 * Coulomb-Stribeck friction with true sticking, against a counterface (belt) of speed v_b; with an engagement e(t), 0
 * to 1, a brake or a clutch.
 *
 * Measure u [m or rad]; generalised force p [N or N m], three branches:
 *
 *     slip forward      u' > v_b      p = -e R(v) - d v,     v = |u' - v_b|
 *     slip backward     u' < v_b      p = +e R(v) + d v
 *     stick             u' = v_b      p is the sticking force, |p| <= e R0
 *
 * R(v) is the kinetic force R, or decreases to it from R0 along a Stribeck curve; d is viscous.  For e = 0 it is
 * released: only d acts.
 *
 * Sticking ends when the sticking force reaches e R0: p < 0 slips forward, p > 0 backward. It
 * begins when u' - v_b becomes zero, for any load; if the load is too large, a guard of the new branch is past zero
 * from its start and slip follows at the same instant. So a slide reverses by two events, stick and slip. A motion that
 * starts with u' = v_b starts sticking.
 *
 * In an ideal joint R and R0 are given per unit of its normal force N, which
 * multiplies them like e: limit and friction follow the multipliers.
 *
 * The element needs an integrator that locates events.  Without history (by_history = false) force() has the sign of
 * the sliding speed u' - v_b and is zero at rest; with history it is zero and unused while sticking (holds()).
 *
 * Against ground (v_b = 0) its work is dissipated; a belt is a drive: its work, minus the loss by sliding, counts as
 * input.  For natural frequencies it has no stiffness.
 *
 * Source: docs/theory/elements.md; Stribeck.
 */
class CoulombFriction : public DifferentiableElement<CoulombFriction, 1, Branches, Structure, Commands>
{
public:
  struct Parameters
  {
    double kinetic_force = 0.; ///< R [N or N m], >= 0
    double static_force  = 0.; ///< R0 [N or N m], >= R
    double belt_speed    = 0.; ///< v_b [m/s or rad/s]

    double           stribeck_speed    = 0.; ///< v_s [m/s or rad/s], >= 0; 0: R drops at once
    double           stribeck_exponent = 1.; ///< 1 or 2
    double           viscous           = 0.; ///< d [N s/m or N m s/rad], >= 0
    CommandedProfile engagement        = 1.; ///< e, 0 to 1; a level or a profile

    std::optional<JointLoad> load = std::nullopt; ///< of a joint: R and R0 are per unit of its N [1 or m]
  };

  explicit CoulombFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Branch branch = m.by_history ? branch_of(history) : branch_at(value(m.v[0]));
    const Number v      = m.v[0] - parameters_.belt_speed;
    p[0]                = -parameters_.viscous * v;
    if (branch == stick || branch == released)
      return;
    const double sign = branch, N = engagement(m.t, m.by_history, history) * normal_force(m.lambda);
    p[0] -= sign * N * sliding_.force(Number(sign * v));
  }

  void engaged(const double *u, double *K, double *D) const override; ///< d

  /// history: active branch; that of the engagement.
  int  n_history() const override { return 1 + parameters_.engagement.n_history(); }
  void start(const LocalMotion &motion, double *history) const override;
  void resume(const LocalMotion &motion, double *history) const override;
  bool holds(const double *history, double &rate) const override;
  Work work() const override { return parameters_.belt_speed == 0. ? Work::dissipated : Work::input; }

  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  bool command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override { return CommandedProfile::commands(); }
  void                     check_order(const SwitchCommand &order) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  /// The sign of the sliding speed u' - v_b.
  enum Branch
  {
    slip_backward = -1,
    stick         = 0,
    slip_forward  = 1,
    released      = 2
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[0])); }
  Branch        branch_at(double v) const
  {
    return v > parameters_.belt_speed ? slip_forward : v < parameters_.belt_speed ? slip_backward : stick;
  }

  double engagement(double t, bool by_history, const double *history) const
  {
    return parameters_.engagement.at(t, by_history, history + 1).value;
  }
  double normal_force(const double *lambda) const
  {
    return parameters_.load ? parameters_.load->normal_force(lambda) : 1.;
  }
  void find_branch(const LocalMotion &motion, double *history) const;       ///< for a motion that starts here
  void follow_engagement(const LocalMotion &motion, double *history) const; ///< releases, or engages again
  int  n_own_guards(const double *history) const;                           ///< all except that of the engagement

  Parameters parameters_;
  Stribeck   sliding_;
};

} // namespace gestell::mechanism
