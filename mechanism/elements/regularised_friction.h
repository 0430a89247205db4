#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Coulomb friction smoothed near rest:   p = -F tanh(u'/v0)       [N]
 *
 * Sticking is replaced by slow creep of order v0; a joint that must truly stick needs CoulombFriction.
 */
class RegularisedFriction : public DifferentiableElement<RegularisedFriction, 1>
{
public:
  struct Parameters
  {
    double force = 0.;   ///< F [N or N m], >= 0
    double speed = 1e-3; ///< v0 [m/s or rad/s], > 0
  };

  explicit RegularisedFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    using std::tanh;
    p[0] = -parameters_.force * tanh(m.v[0] / parameters_.speed);
  }

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
