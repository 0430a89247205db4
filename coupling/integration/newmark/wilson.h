#pragma once

#include "coupling/integration/newmark/one_step.h"

namespace gestell::coupling
{

/**
 * Wilson's theta method with fixed step: the acceleration is linear over theta h and the equation of motion is
 * fulfilled at t + theta h,
 *
 *     M a_theta + B v_theta + C q_theta = f_0 + theta (f_1 - f_0) + W p_theta,     x = (theta h)^2 a_theta,
 *     q_theta = q_0 + theta h v_0 + (theta h)^2/3 a_0 + x/6,     v_theta = v_0 + theta h/2 a_0 + x/(2 theta h),
 *     a_1 = a_0 + (a_theta - a_0)/theta,     v_1 = v_0 + h (a_0 + a_1)/2,     q_1 = q_0 + h v_0 + h^2 (2 a_0 + a_1)/6.
 *
 * The load is extrapolated linearly from the ends of the step.  The forces of the elements are evaluated at t + theta
 * h, for the motion of the method there: an event between t + h and t + theta h acts before it happens.  local().p at t
 * + h is evaluated again; that of sticking measures is interpolated linearly between t and t + theta h.
 *
 * Second order; unconditionally stable for theta >= (1 + sqrt 3)/2 = 1.36603.  It overshoots: after the first step, a
 * stiff mode with an initial displacement has an amplitude that grows like (omega h)^2 (theta = 1.4: 14 and 1430 times
 * for omega h = 10 and 100).
 *
 * Source: Wilson, Farhoomand & Bathe, Earthq. Eng. Struct. Dyn. 1, 1973; docs/theory/integration.md.
 */
class Wilson final : public OneStep
{
public:
  struct Options
  {
    double        theta        = 1.4; ///< >= 1
    double        step         = 0.;  ///< h [s], > 0
    int           max_halvings = 10;
    NewtonOptions newton{};
  };

  /// @throws std::invalid_argument for theta < 1, a step that is not positive, a singular M
  Wilson(const SecondOrderSystem &system, const Options &options);

private:
  void formula_step(const Point &from, double h, Point &to) override;

  double          theta_;
  LocalState      base_, ahead_;
  Eigen::VectorXd f_, q_, v_, product_, x_;
};

} // namespace gestell::coupling
