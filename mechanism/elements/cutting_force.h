#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/one_sided_contact.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Smooth cutting force without hysteresis, for a tool with resistance during feed only.
 *
 * Measure u [m]; penetration z = u - x_T > 0:
 *
 *     p = -F (z/z_p) exp(1 - z/z_p) [1 + tanh(u'/v0)]/2,        otherwise p = 0.
 *
 * The largest force F is reached at z = z_p.  Its work is dissipated.
 */
class CuttingForce : public DifferentiableElement<CuttingForce, 1, OneSidedContact, Structure>
{
public:
  struct Parameters
  {
    double peak_force       = 0.;   ///< F [N], >= 0
    double peak_penetration = 0.;   ///< z_p [m], > 0
    double contact_at       = 0.;   ///< x_T [m]
    double speed            = 1e-2; ///< v0 [m/s], > 0
  };

  explicit CuttingForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    using std::tanh;
    const auto &[F, z_p, x_T, v0] = parameters_;
    const Number x                = (m.u[0] - x_T) / z_p;
    if (!(m.by_history ? is_closed(history) : closes(value(m.u[0]), value(m.v[0]))))
    {
      p[0] = Number(0.);
      return;
    }
    const Number gate = 0.5 * (1. + tanh(m.v[0] / v0));
    p[0]              = -F * shape(x) * gate;
  }

  /// F e / z_p, the initial slope of the force.
  void stiffest(const double *u, double *K, double *D) const override;

  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  std::string event(bool closing) const final { return closing ? "tool_contact" : "tool_release"; }
  bool        closes(double u, double) const final { return u > parameters_.contact_at; }

  /// x exp(1 - x); far below the switching point x = 0, which only trial motions reach, its tangent at x = -1: finite.
  template <typename Number>
  static Number shape(const Number &x)
  {
    using std::exp;
    if (x < -1.)
      return std::exp(2.) * (2. * x + 1.);
    return x * exp(1. - x);
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
