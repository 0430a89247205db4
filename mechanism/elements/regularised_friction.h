#pragma once

#include "mechanism/stribeck.h"

namespace gestell::mechanism
{

/**
 * Friction smoothed near rest:   p = -R(|u'|) tanh(u'/v0) - d u'       [N]
 *
 * R(v) is the kinetic force F, or falls to it from the static one along a Stribeck curve.
 * Sticking is replaced by slow creep of order v0; a joint that must truly stick needs CoulombFriction.
 */
class RegularisedFriction : public DifferentiableElement<RegularisedFriction, 1>
{
public:
  struct Parameters
  {
    double force = 0.;   ///< F [N or N m], >= 0
    double speed = 1e-3; ///< v0 [m/s or rad/s], > 0

    double static_force      = 0.; ///< R0 [N or N m], >= F; unused without a Stribeck speed
    double stribeck_speed    = 0.; ///< v_s [m/s or rad/s], >= 0; 0: none
    double stribeck_exponent = 1.; ///< 1 or 2
    double viscous           = 0.; ///< d [N s/m or N m s/rad], >= 0
  };

  explicit RegularisedFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    using std::tanh;
    const Number v = m.v[0];
    p[0]           = -sliding_.force(v < 0. ? Number(-v) : v) * tanh(v / parameters_.speed) - parameters_.viscous * v;
  }

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
  Stribeck   sliding_;
};

} // namespace gestell::mechanism
