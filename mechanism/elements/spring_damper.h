#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Spring and damper on one measure u, such as the distance between two points of rotating bodies: F = F_0 + c (u - u_0)
 * + b u', p = -F. Along a constant direction they are part of the linear base system instead.
 */
class SpringDamper : public DifferentiableElement<SpringDamper, 1, Structure>
{
public:
  struct Parameters
  {
    double stiffness = 0.; ///< c [N/m or N m/rad], >= 0
    double damping   = 0.; ///< b [N s/m or N m s/rad], >= 0
    double preload   = 0.; ///< F_0 [N or N m]
    double rest      = 0.; ///< u_0 [m or rad]
  };

  /// @throws std::invalid_argument for a negative stiffness or damping
  explicit SpringDamper(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    const auto &[c, b, F_0, u_0] = parameters_;
    p[0]                         = -(F_0 + c * (m.u[0] - u_0) + b * m.v[0]);
  }

  void                  engaged(const double *u, double *K, double *D) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
