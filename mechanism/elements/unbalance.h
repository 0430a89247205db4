#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Unbalance of a rotor: its centre of mass is off its axis, which couples rotation and the motion of the carrier.
 * Measures u = (phi, x_1, x_2): angle of the rotor [rad] and displacements of the point of its axis [m] along e_1, e_2
 * normal to the axis, e_1 x e_2 along it.  With
 *
 *     n = (cos, sin)(phi + psi),     t = dn/dphi,     U = m e [kg m],
 *
 * the additional kinetic energy beyond mass and inertia of the rotor, T = U phi' x'.t, and the weight -U g.n give
 *
 *     p_phi = -U (x'' - g).t,     p_x = U (phi'^2 n - phi'' t):
 *
 * the centrifugal force on the carrier, and the torque by which a vibrating carrier brakes the rotor (Sommerfeld). The
 * forces change only T and the potential energy.
 *
 * Source: docs/theory/elements.md, Unbalance.
 * foundation).
 */
class Unbalance : public DifferentiableElement<Unbalance, 3>
{
public:
  struct Parameters
  {
    double unbalance  = 0.; ///< U = m e [kg m], >= 0
    double phase      = 0.; ///< psi [rad] of the centre of mass at phi = 0, from e_1 towards e_2
    double gravity[2] = {}; ///< g along e_1, e_2 [m/s^2]
  };

  explicit Unbalance(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    using std::cos, std::sin;
    const auto &[U, psi, g] = parameters_;
    const Number c = cos(m.u[0] + psi), s = sin(m.u[0] + psi); // n = (c, s), t = (-s, c)
    p[0] = U * ((m.a[1] - g[0]) * s - (m.a[2] - g[1]) * c);
    p[1] = U * (m.v[0] * m.v[0] * c + m.a[0] * s);
    p[2] = U * (m.v[0] * m.v[0] * s - m.a[0] * c);
  }

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
