#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/// Spring with a linear and a cubic part:   p = -(c u + c3 u^3)      [N],   energy c u^2/2 + c3 u^4/4.
class CubicSpring : public DifferentiableElement<CubicSpring, 1, Structure>
{
public:
  struct Parameters
  {
    double stiffness = 0.; ///< c [N/m]
    double cubic     = 0.; ///< c3 [N/m^3]
  };

  explicit CubicSpring(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    p[0] = -(parameters_.stiffness + parameters_.cubic * m.u[0] * m.u[0]) * m.u[0];
  }

  void                  engaged(const double *u, double *K, double *D) const override;
  bool                  stiffens() const override { return parameters_.cubic > 0.; }
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
