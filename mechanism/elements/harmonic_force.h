#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>
#include <vector>

namespace gestell::mechanism
{

/**
 * External load on a measure u [m or rad] whose direction turns with the motion, such as that of a point of a turning
 * body:
 *
 *     p = f(t) = f_0 + sum A_i sin(omega_i t + phi_i)      [N or N m]
 *
 * Its work counts as input.  Along a constant direction the system's excitation takes such a load instead.
 */
class HarmonicForce : public DifferentiableElement<HarmonicForce, 1>
{
public:
  struct Oscillation
  {
    double omega, amplitude, phase; ///< [rad/s], [N or N m], [rad]
  };
  struct Parameters
  {
    double                   constant = 0.; ///< f_0 [N or N m]
    std::vector<Oscillation> oscillations;
    bool                     torque = false; ///< u is an angle
  };

  explicit HarmonicForce(const Parameters &parameters) : parameters_(parameters) {}

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    double f = parameters_.constant;
    for (const Oscillation &part : parameters_.oscillations)
      f += part.amplitude * std::sin(part.omega * m.t + part.phase);
    p[0] = Number(f);
  }

  Work                  work() const override { return Work::input; }
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
