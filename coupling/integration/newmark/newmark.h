#pragma once

#include "coupling/integration/newmark/one_step.h"

namespace gestell::coupling
{

/**
 * Newmark's family with fixed step: Newmark, HHT-alpha, generalised alpha, central differences.
 *
 *     q_1 = q_0 + h v_0 + h^2 (1/2 - beta) a_0 + beta x,     v_1 = v_0 + h (1 - gamma) a_0 + gamma x / h,
 *     x = h^2 a_1
 *
 *     M [(1 - alpha_m) a_1 + alpha_m a_0] + B [(1 - alpha_f) v_1 + alpha_f v_0] + C [(1 - alpha_f) q_1 + alpha_f q_0]
 *       = (1 - alpha_f) (f_1 + W p_1) + alpha_f (f_0 + W p_0)
 *
 * Forces are averaged, not evaluated at an averaged state: p_1 is that of the motion at the end of the step, and has
 * the factor h^2 (1 - alpha_f)/(1 - alpha_m) in the condensed equation.
 *
 * Second order if gamma = 1/2 - alpha_m + alpha_f, otherwise first.  The acceleration in the state of generalised alpha
 * and HHT is that at t + (alpha_m - alpha_f) h; that of the measures, local().a, is shifted to t (second order).
 *
 * Sources: Newmark, J. Eng. Mech. Div. ASCE 85, 1959; Hilber, Hughes & Taylor, Earthq. Eng. Struct. Dyn. 5, 1977;
 * Chung & Hulbert, J. Appl. Mech. 60, 1993; docs/theory/integration.md.
 */
class Newmark final : public OneStep
{
public:
  struct Options
  {
    double        beta         = 0.25; ///< >= 0
    double        gamma        = 0.5;  ///< > 0
    double        alpha_m      = 0.;   ///< weight of a_0, < 1
    double        alpha_f      = 0.;   ///< weight of the forces at the beginning, in [0, 1)
    double        step         = 0.;   ///< h [s], > 0
    int           max_halvings = 10;
    NewtonOptions newton{};
  };

  /// alpha in [-1/3, 0]: alpha_f = -alpha, beta = (1 - alpha)^2/4, gamma = 1/2 - alpha.  The step must be set
  /// afterwards.
  /// @throws std::invalid_argument for alpha outside this range
  static Options hht(double alpha);
  /// rho_inf in [0, 1], the spectral radius as omega h goes to infinity.
  /// @throws std::invalid_argument for rho_inf outside this range
  static Options generalised_alpha(double rho_inf);
  /// Central differences: beta = 0, gamma = 1/2, with the velocity v = (q_+ - q_-)/(2 h); explicit in q, implicit in v.
  static Options central_difference();

  /// @throws std::invalid_argument for parameters outside their range, a step that is not positive, a singular M
  Newmark(const SecondOrderSystem &system, const Options &options);

private:
  void formula_step(const Point &from, double h, Point &to) override;

  Options         options_;
  LocalState      base_;
  Eigen::VectorXd f_, mean_, product_, x_;
};

} // namespace gestell::coupling
