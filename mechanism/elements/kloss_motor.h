#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Asynchronous motor by Kloss' formula, referred to the driven shaft.
 *
 * Measure u: angle of the driven shaft [rad]; torque on it, driving positive, acts as p = M:
 *
 *     s = 1 - i u'/Omega_sync,     M = sign(Omega_sync) i 2 M_K s s_K / (s^2 + s_K^2)          [N m]
 *
 * A negative synchronous speed is reverse running: M(-u', -Omega_sync) = -M(u', Omega_sync).
 *
 * Source: Kloss 1901; reference model of the crank press, section 3.
 */
class KlossMotor : public DifferentiableElement<KlossMotor, 1>
{
public:
  struct Parameters
  {
    double breakdown_torque  = 0.; ///< M_K [N m] of the motor, > 0
    double breakdown_slip    = 0.; ///< s_K, > 0
    double synchronous_speed = 0.; ///< Omega_sync [rad/s] of the motor, != 0
    double ratio             = 1.; ///< i, motor speed / shaft speed, > 0
  };

  explicit KlossMotor(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    const auto &[M_K, s_K, sync, i] = parameters_;
    const Number s                  = 1. - i / sync * m.v[0];
    p[0]                            = std::copysign(2. * i * M_K * s_K, sync) * s / (s * s + s_K * s_K);
  }

  Work                  work() const override { return Work::input; }
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const Parameters &parameters() const { return parameters_; }

private:
  Parameters parameters_;
};

} // namespace gestell::mechanism
