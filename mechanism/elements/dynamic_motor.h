#pragma once

#include "mechanism/elements/kloss_motor.h"

namespace gestell::mechanism
{

/**
 * Asynchronous motor with its dynamic characteristic: the torque follows the stationary Kloss characteristic with a
 * first-order lag.
 *
 * Measures: phi [rad], angle of the driven shaft; M [N m], torque on this shaft, a lag of the electrical time constant
 * T_e, which belongs to whoever places it:
 *
 *     T_e M' + M = M_stat(phi'),     p_phi = M,     p_M = M_stat,     M_stat by KlossMotor
 *
 * M is massless: the virtual coordinate of section 5.5.3 of Dresig and Vul'fson.  For the linear part of Kloss' formula
 * T_e = 1/(2 pi f s_K) with the frequency f of the mains.
 *
 * Source: Dresig, Vul'fson, Dynamik der Mechanismen, 5.5.3.
 */
class DynamicMotor : public DifferentiableElement<DynamicMotor, 2>
{
public:
  explicit DynamicMotor(const KlossMotor::Parameters &parameters) : motor_(parameters) {}

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    motor_.law<Number>(m, nullptr, &p[1]);
    p[0] = m.u[1];
  }

  Work                  work() const override { return Work::input; }
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const KlossMotor &stationary() const { return motor_; } ///< its characteristic without the lag

private:
  KlossMotor motor_;
};

} // namespace gestell::mechanism
