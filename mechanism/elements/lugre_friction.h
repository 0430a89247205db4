#pragma once

#include "mechanism/joint_load.h"
#include "mechanism/stribeck.h"

#include <optional>

namespace gestell::mechanism
{

/**
 * Friction with bristles (LuGre): presliding, stick-slip and hysteresis without switching.
 *
 * Measures: u [m or rad]; F = sigma_0 z [N], force of the bristles deflected by z, a lag of the time constant T =
 * lag(). With the Stribeck curve R(v), v = u':
 *
 *     z'  = v - |v| F / R(|v|)
 *     p_u = -(F + sigma_1 z' + d v)
 *     F'  = sigma_0 z'      written as      T F' + F = p_F,     p_F = F + T sigma_0 z'
 *
 * T is only the scale of the virtual coordinate and does not change the motion.  In steady sliding F = R(v) sign(v);
 * for small motions it is a spring sigma_0 and a damper sigma_1 + d.  The stored energy is F^2/(2 sigma_0).  Where v
 * changes its sign |v| has a kink: event "reversal".
 *
 * In an ideal joint all forces are per unit of its normal force N, which multiplies p_u; z is independent of it. The
 * energy stored in the bristles is then treated as dissipated.
 *
 * Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419-425.
 */
class LuGreFriction : public DifferentiableElement<LuGreFriction, 2, Branches, Structure>
{
public:
  struct Parameters
  {
    double kinetic_force     = 0.; ///< R [N or N m], > 0
    double static_force      = 0.; ///< R0 [N or N m], >= R
    double stribeck_speed    = 0.; ///< v_s [m/s or rad/s], >= 0; 0: no Stribeck curve, R everywhere
    double stribeck_exponent = 2.; ///< 1 or 2
    double bristle_stiffness = 0.; ///< sigma_0 [N/m or N m/rad], > 0
    double bristle_damping   = 0.; ///< sigma_1 [N s/m or N m s/rad], >= 0
    double viscous           = 0.; ///< d [N s/m or N m s/rad], >= 0

    std::optional<JointLoad> load = std::nullopt; ///< of a joint: forces are per unit of its N
  };

  explicit LuGreFriction(const Parameters &parameters);

  static constexpr double lag() { return 1e-3; } ///< T [s]

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const bool   backward = m.by_history ? history[0] < 0. : m.v[0] < 0.;
    const Number v        = m.v[0];
    const Number speed    = backward ? Number(-v) : v;
    const Number z_rate   = v - speed * m.u[1] / sliding_.force(speed);
    const double N        = parameters_.load ? parameters_.load->normal_force(m.lambda) : 1.;
    p[0]                  = -N * (m.u[1] + parameters_.bristle_damping * z_rate + parameters_.viscous * v);
    p[1]                  = m.u[1] + lag() * parameters_.bristle_stiffness * z_rate;
  }

  /// sigma_0, sigma_1 + d: for small motions the joint is a spring.  Zero if N is unknown.
  void stiffest(const double *u, double *K, double *D) const override;

  /// history: the sign of v.
  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  int                   n_guards(const double *) const override { return 1; }
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  Parameters parameters_;
  Stribeck   sliding_;
};

} // namespace gestell::mechanism
