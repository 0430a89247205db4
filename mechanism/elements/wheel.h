#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Elastic wheel or foot that stands on the ground and may leave it.  Measure s: height of its hub above the position in
 * which the tyre is just unloaded; compression u = -s.
 *
 *     contact:  F = c u + d u'     until F falls to zero ("lift_off"): before the tyre is unloaded, as it cannot pull
 *     free:     F = 0              until u > 0 and c u + d u' > 0 again ("touch_down"), where F jumps to d u'
 *
 * p = F on s.  With `bilateral` it never leaves the ground.  The energy left in the tyre at lift-off is lost while it
 * unloads.
 *
 * Source: reference model of the mobile crane, sections 3 and 4; docs/theory/elements.md.
 */
class Wheel : public DifferentiableElement<Wheel, 1>
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
    const bool   stands =
        parameters_.bilateral || (m.by_history ? history[0] != 0. : value(u) >= 0. && value(force) >= 0.);
    p[0] = stands ? force : Number(0. * force);
  }

  /// history: 1 in contact, 0 free.
  int    n_history() const override { return 1; }
  void   start(const LocalMotion &motion, double *history) const override;
  void   engaged(const double *u, double *K, double *D) const override;
  void   open_branch(const double *u, double *K, double *D) const override;
  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;

  int                n_guards(const double *) const override { return parameters_.bilateral ? 0 : 1; }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  double deflection(const LocalMotion &motion) const;
  double force_in_contact(const LocalMotion &motion) const
  {
    return -parameters_.stiffness * motion.u[0] - parameters_.damping * motion.v[0];
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
