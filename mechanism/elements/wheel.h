#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/one_sided_contact.h"

namespace gestell::mechanism
{

/**
 * Elastic wheel or foot on the ground that can lift off. Measure s: height of its hub above the unloaded position;
 * compression u = -s.
 *
 *     contact:  F = c u + d u'     until F falls to zero ("lift_off"): before the tyre is unloaded, as it has no
 * tension free:     F = 0              until u > 0 and c u + d u' > 0 again ("touch_down"), where F jumps to d u'
 *
 * p = F on s.  With `bilateral` it never leaves the ground.  The energy left in the tyre at lift-off is lost while it
 * unloads.
 *
 * Source: reference model of the mobile crane, sections 3 and 4; docs/theory/elements.md.
 */
class Wheel : public DifferentiableElement<Wheel, 1, OneSidedContact, Structure>
{
public:
  struct Parameters
  {
    double stiffness = 0.; ///< c [N/m], > 0
    double damping   = 0.; ///< d [N s/m], >= 0
    bool   bilateral = false;
  };

  /// @throws std::invalid_argument for parameters out of range
  explicit Wheel(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number u = -m.u[0], force = parameters_.stiffness * u - parameters_.damping * m.v[0];
    const bool   at_rest =
        parameters_.bilateral || (m.by_history ? is_closed(history) : closes(value(m.u[0]), value(m.v[0])));
    p[0] = at_rest ? force : Number(0. * force);
  }

  const Branches *branches() const override { return parameters_.bilateral ? nullptr : this; }

  void   engaged(const double *u, double *K, double *D) const override;
  void   open_branch(const double *u, double *K, double *D) const override;
  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;
  void   guard_values(const LocalMotion &motion, const double *history, double *g) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  double deflection(const LocalMotion &motion) const;
  double force_in_contact(double u, double v) const { return -parameters_.stiffness * u - parameters_.damping * v; }
  std::string event(bool closing) const final { return closing ? "touch_down" : "lift_off"; }
  bool        closes(double u, double v) const final { return u <= 0. && force_in_contact(u, v) >= 0.; }

  Parameters parameters_;
};

} // namespace gestell::mechanism
