#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/commanded_profile.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Hydraulic cylinder with the elasticity of its oil columns.
 *
 * Measures: u [m], with the stroke x = u - u_0, which grows as chamber A is filled; a, b [m], virtual coordinates: the
 * piston displacements by the oil fed into A and B for incompressible oil.  With the columns L_a = V_a/A and L_b =
 * V_b/B at x = 0 and the bulk modulus K
 *
 *     p_a = p_a0 + K ln[(L_a + a)/(L_a + x)],     p_b = p_b0 + K ln[(L_b + b)/(L_b - x)],     F = A p_a - B p_b
 *     a' = (Q_a/A) exp[(p_a - p_a0)/K],           b' = (Q_b/B) exp[(p_b - p_b0)/K]
 *
 * which is  V p'/K = Q - A x'  in each chamber, exactly, with V = A (L_a + x).  The states are fed lengths instead of
 * pressures: the force is then a function of state with the stiffness  K (A^2/V_a + B^2/V_b)  of closed columns, and
 * all unknowns are lengths.  They have the time constant T = 1 s in  T a' + a = p,  with p = a + T a'.
 *
 * Flow:  Q_a = Q(t), Q_b = -Q B/A  commanded by a profile; or through a valve of the opening y(t) in [-1, 1],
 *
 *     y > 0:  Q_a = Q_N y r(p_S - p_a),   Q_b = -Q_N y r(p_b - p_T)
 *     y < 0:  Q_a = Q_N y r(p_a - p_T),   Q_b = -Q_N y r(p_S - p_b),     r(d) = d/d_N / ((d/d_N)^2 + e^2)^(1/4),
 *
 * sqrt(d/d_N) except for small d.  Leakage past the piston: k_L (p_a - p_b) from A to B.  The work on the machine, F
 * x', is input. Cavitation is not modelled: a pressure may become negative, which is visible in the signals.
 *
 * Source: H. Murrenhoff, Fundamentals of Fluid Power, Part 1: Hydraulics; docs/theory/position_functions.md (5).
 */
class HydraulicCylinder : public DifferentiableElement<HydraulicCylinder, 3, Branches, Structure, Commands>
{
public:
  enum class Control
  {
    flow, ///< course: Q [m^3/s]
    valve ///< course: y [1]
  };
  struct Parameters
  {
    double           area_a = 0., area_b = 0.;         ///< A, B [m^2], > 0
    double           volume_a = 0., volume_b = 0.;     ///< V_a, V_b at x = 0 [m^3], > 0
    double           zero         = 0.;                ///< u_0 [m]
    double           bulk_modulus = 1.4e9;             ///< K [Pa], > 0
    double           pressure_a = 0., pressure_b = 0.; ///< p_a0, p_b0 at x = 0 [Pa]
    double           leakage = 0.;                     ///< k_L [m^3/(s Pa)], >= 0
    Control          control = Control::flow;
    CommandedProfile course;
    double           rated_flow = 0., rated_drop = 0.; ///< of the valve: Q_N [m^3/s] at d_N [Pa], > 0
    double           supply = 0., tank = 0.;           ///< p_S, p_T [Pa]
  };

  static constexpr double lag = 1.; ///< T [s]

  explicit HydraulicCylinder(const Parameters &parameters);

  template <typename Number>
  struct Chambers
  {
    Number p_a, p_b, q_a, q_b;
  };

  template <typename Number>
  Chambers<Number> chambers(const Number &x, const Number &a, const Number &b, double course) const
  {
    using std::log;
    const auto      &P   = parameters_;
    const double     L_a = P.volume_a / P.area_a, L_b = P.volume_b / P.area_b;
    Chambers<Number> c;
    c.p_a                = P.pressure_a + P.bulk_modulus * log(Number((L_a + a) / (L_a + x)));
    c.p_b                = P.pressure_b + P.bulk_modulus * log(Number((L_b + b) / (L_b - x)));
    const Number leaking = P.leakage * (c.p_a - c.p_b);
    if (P.control == Control::flow)
    {
      c.q_a = course - leaking;
      c.q_b = -course * P.area_b / P.area_a + leaking;
      return c;
    }
    const double q = P.rated_flow * course;
    c.q_a          = q * root(course > 0. ? Number(P.supply - c.p_a) : Number(c.p_a - P.tank)) - leaking;
    c.q_b          = -q * root(course > 0. ? Number(c.p_b - P.tank) : Number(P.supply - c.p_b)) + leaking;
    return c;
  }

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    using std::exp;
    const auto            &P = parameters_;
    const Chambers<Number> c =
        chambers<Number>(Number(m.u[0] - P.zero), m.u[1], m.u[2], course(m.t, m.by_history, history));
    p[0] = P.area_a * c.p_a - P.area_b * c.p_b;
    p[1] = m.u[1] + (lag / P.area_a) * c.q_a * exp(Number((c.p_a - P.pressure_a) / P.bulk_modulus));
    p[2] = m.u[2] + (lag / P.area_b) * c.q_b * exp(Number((c.p_b - P.pressure_b) / P.bulk_modulus));
  }

  /// Strokes x [m] at which an oil column ends: -L_a and L_b.
  double lower_end() const { return -parameters_.volume_a / parameters_.area_a; }
  double upper_end() const { return parameters_.volume_b / parameters_.area_b; }

  /// With closed columns.
  void engaged(const double *u, double *K, double *D) const override;
  Work work() const override { return Work::input; }

  int                n_history() const override { return parameters_.course.n_history(); }
  void               start(const LocalMotion &motion, double *history) const override;
  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  bool command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override { return CommandedProfile::commands(); }
  void                     check_order(const SwitchCommand &order) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  double course(double t, bool by_history, const double *history) const
  {
    return parameters_.course.at(t, by_history, history).value;
  }
  template <typename Number>
  Number root(const Number &drop) const
  {
    using std::sqrt;
    constexpr double laminar = 1e-3; ///< e
    const Number     d       = drop / parameters_.rated_drop;
    return d / sqrt(Number(sqrt(Number(d * d + laminar * laminar))));
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
