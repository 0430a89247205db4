#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Clearance between two stops along one direction, or a single stop, with an elastic, dissipative contact without
 * tension. Measure u [m or rad]: displacement from the centre of the clearance, or from the reference of a single stop;
 * s = sign(u) for a clearance, s = 1 for a stop above, s = -1 for a stop below; d = s u - gap:
 *
 *     d > 0 and 1 + chi s u' > 0:   p = -s c d^n (1 + chi s u'),        otherwise p = 0.
 *
 * n = 1 for a spring, 1.5 for Hertzian point contact.  Stored is c d^(n+1)/(n+1).
 *
 * The factor (Hunt and Crossley) makes the force continuous at touch-down and lift-off. If the body leaves faster than
 * 1/chi the force vanishes before the indentation (slack branch): until lift-off ("separation"), or until the body
 * slows down and the factor is positive again. Source: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445,
 * with any n.
 */
class Clearance : public DifferentiableElement<Clearance, 1, Branches, Structure>
{
public:
  enum class Stops
  {
    both,
    above, ///< contact where u > gap
    below  ///< contact where -u > gap
  };

  struct Parameters
  {
    double gap         = 0.; ///< [m], half of the total clearance, >= 0; any value for a single stop
    double stiffness   = 0.; ///< c [N/m^n], > 0
    double dissipation = 0.; ///< chi [s/m], >= 0
    Stops  stops       = Stops::both;
    double exponent    = 1.; ///< n, >= 1
  };

  /// chi [s/m] for which two bodies that collide at the speed v [m/s], moved only by the contact, separate at e v: (1 +
  /// e) chi v = ln[(1 + chi v) / (1 - chi e v)], for any masses, stiffness and exponent (docs/theory/elements.md, 11).
  /// Requires 0 < e <= 1 and v > 0, else throws std::invalid_argument.
  static double dissipation_for(double restitution, double speed);

  explicit Clearance(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    double       s;
    const Number pressed = pressure(m, history, s);
    p[0]                 = s == 0. ? Number(0.) : Number(-s * pressed);
  }

  /// c d^n (1 + chi s u') >= 0 and the s of its stop; 0 without contact.
  template <typename Number>
  Number pressure(const Measures<Number> &m, const double *history, double &s) const
  {
    const auto &[gap, c, chi, stops, n] = parameters_;
    const Branch branch                 = branch_for(m, history);
    s                                   = 0.;
    if (branch != contact_negative && branch != contact_positive)
      return Number(0.);
    s                   = side(branch);
    const Number d      = s * m.u[0] - gap;
    const Number factor = 1. + (chi * s) * m.v[0];
    return c * power(d) * factor;
  }

  /// history: active branch.
  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  void                  engaged(const double *u, double *K, double *D) const override;
  void                  open_branch(const double *, double *, double *) const override {}
  bool                  stiffens() const override { return parameters_.exponent > 1.; }
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  double                penetration(const LocalMotion &motion) const override;
  Play                  play(const double *u, const double *v, double *G) const override;
  double                yielding(double force) const override;
  int                   n_guards(const double *history) const override;
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const Parameters &parameters() const { return parameters_; }

private:
  enum Branch
  {
    slack_negative   = -2,
    contact_negative = -1,
    open             = 0,
    contact_positive = 1,
    slack_positive   = 2
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[0])); }
  static double side(Branch branch) { return branch < 0 ? -1. : 1.; } ///< s; without meaning if open
  static bool   in_slack(Branch branch) { return branch == slack_negative || branch == slack_positive; }

  /// The requested branch.
  template <class Motion>
  Branch branch_for(const Motion &m, const double *history) const
  {
    return m.by_history ? branch_of(history) : branch_at(value(m.u[0]), value(m.v[0]));
  }

  Branch branch_at(double u, double v) const
  {
    const auto &[gap, c, chi, stops, n] = parameters_;
    const double s                      = stops == Stops::both ? (u < 0. ? -1. : 1.) : stops == Stops::above ? 1. : -1.;
    if (!(s * u - gap > 0.))
      return open;
    const bool pressed = 1. + (chi * s) * v > 0.;
    return s < 0. ? (pressed ? contact_negative : slack_negative) : (pressed ? contact_positive : slack_positive);
  }

  /// d^n; below d = 0, which only trial motions reach, it is linear for n = 1 and zero otherwise.
  template <typename Number>
  Number power(const Number &d) const
  {
    using std::pow;
    if (parameters_.exponent == 1.)
      return d;
    return d > 0. ? Number(pow(d, parameters_.exponent)) : Number(0.);
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
