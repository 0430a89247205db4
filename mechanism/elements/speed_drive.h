#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * Drive with speed control (PI) and limited torque.
 *
 * Measures: phi [rad], angle of the driven shaft; z [N m], a lag of the time constant T_i = k_p/k_i that follows the
 * torque.  With the commanded speed w_r(t) of a profile
 *
 *     M = k_p (w_r - phi') + z,  but  -M_max <= M <= M_max        [N m],     p_phi = M
 *     T_i z' + z = M,                                                         p_z   = M
 *
 * Within the limits T_i z' = k_p (w_r - phi'): z is k_i times the integral of the error.  At a limit z follows the
 * actual torque, without windup (automatic reset, the same as back-calculation with the tracking time T_i). Without an
 * integral (k_i = 0) z stays zero.
 *
 * Events: corners of the profile, "limit_reached", "limit_left".  Its work is input, negative if it brakes.
 *
 * Source: K. J. Astrom, T. Hagglund, PID Controllers, 2nd ed. 1995 (automatic reset, windup).
 */
class SpeedDrive : public DifferentiableElement<SpeedDrive, 2, Branches, Commands>
{
public:
  struct Parameters
  {
    double           proportional_gain = 0.;                 ///< k_p [N m s/rad], > 0
    double           integral_gain     = 0.;                 ///< k_i [N m/rad], >= 0
    double           largest_torque    = Profile::unlimited; ///< M_max [N m], > 0
    CommandedProfile speed;                                  ///< w_r [rad/s]

    std::shared_ptr<InputValue> input{}; ///< w_r set from outside, without commands; null: the profile
  };

  explicit SpeedDrive(const Parameters &parameters);

  const std::shared_ptr<InputValue> &input() const { return parameters_.input; }

  /// Time constant [s] of the second measure; 1 s without an integral.
  double lag() const;

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number M      = wanted(m, history);
    const int    branch = m.by_history ? branch_of(history) : branch_at(value(M));
    p[0]                = branch == 0 ? M : Number(branch * parameters_.largest_torque);
    p[1]                = parameters_.integral_gain > 0. ? p[0] : Number(0.);
  }

  /// history: -1, 1 at a limit, 0 between; that of the profile.
  int                n_history() const override { return 1 + parameters_.speed.n_history(); }
  void               start(const LocalMotion &motion, double *history) const override;
  void               resume(const LocalMotion &motion, double *history) const override;
  Work               work() const override { return Work::input; }
  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;
  bool               command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override;
  std::vector<Quantity>    quantities() const override;
  double                   quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  static int branch_of(const double *history) { return static_cast<int>(history[0]); }
  bool       limited() const { return parameters_.largest_torque < Profile::unlimited; }

  int branch_at(double M) const
  {
    return M > parameters_.largest_torque ? 1 : M < -parameters_.largest_torque ? -1 : 0;
  }

  /// M without limits.
  template <typename Number>
  Number wanted(const Measures<Number> &m, const double *history) const
  {
    return parameters_.proportional_gain * (wanted_speed(m.t, m.by_history, history) - m.v[0]) + m.u[1];
  }
  double wanted_speed(double t, bool by_history, const double *history) const
  {
    return parameters_.input ? parameters_.input->at(t) : parameters_.speed.at(t, by_history, history + 1).value;
  }
  double wanted(const LocalMotion &motion, const double *history) const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
