#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Play between two stops along one direction, with an elastic contact that loses energy and never pulls.
 *
 * Measure u [m or rad]: displacement from the middle of the play; s = sign(u), d = |u| - gap:
 *
 *     d > 0 and 1 + chi s u' > 0:   p = -s c d (1 + chi s u'),        otherwise p = 0.
 *
 * The factor (Hunt and Crossley) makes the force continuous at touch-down and lift-off.
 * Source: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 */
class Clearance : public DifferentiableElement<Clearance, 1>
{
public:
  struct Parameters
  {
    double gap         = 0.; ///< [m], half of the total play, >= 0
    double stiffness   = 0.; ///< c [N/m], > 0
    double dissipation = 0.; ///< chi [s/m], >= 0
  };

  explicit Clearance(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    const auto &[gap, c, chi] = parameters_;
    const double s            = value(m.u[0]) < 0. ? -1. : 1.;
    const Number d            = s * m.u[0] - gap;
    const Number factor       = 1. + (chi * s) * m.v[0];
    p[0]                      = d > 0. && factor > 0. ? Number(-s * c * d * factor) : Number(0.);
  }

  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  void                  engaged(const double *u, double *K, double *D) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  int                   n_guards(const double *history) const override;
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
