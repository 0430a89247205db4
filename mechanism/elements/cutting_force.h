#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Smooth cutting force without memory, for a tool that resists only while it goes in.
 *
 * Measure u [m]; penetration z = u - x_T > 0:
 *
 *     p = -F (z/z_p) exp(1 - z/z_p) [1 + tanh(u'/v0)]/2,        otherwise p = 0.
 *
 * The largest force F is reached at z = z_p.  Its work counts as dissipated.
 */
class CuttingForce : public DifferentiableElement<CuttingForce, 1>
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
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    using std::exp;
    using std::tanh;
    const auto &[F, z_p, x_T, v0] = parameters_;
    const Number x                = (m.u[0] - x_T) / z_p;
    if (!(x > 0.))
    {
      p[0] = Number(0.);
      return;
    }
    const Number shape = x * exp(1. - x);
    const Number gate  = 0.5 * (1. + tanh(m.v[0] / v0));
    p[0]               = -F * shape * gate;
  }

  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  int                   n_guards(const double *) const override { return 1; }
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
