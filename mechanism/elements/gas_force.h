#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>
#include <optional>

namespace gestell::mechanism
{

/**
 * Force of the gas in a cylinder on its piston: polytropic while enclosed, at the pressure of a line while a valve is
 * open.
 *
 * Measure u [m], displacement of the piston; s = 1 if the volume grows with u, s = -1 if it grows with -u:
 *
 *     V = V_c + s A (u - u_0),     p = s A (P - P_a)        [N]
 *
 *     enclosed    P V^n = K
 *     suction     P = P_s, from where P has fallen to P_s until the volume no longer grows
 *     delivery    P = P_d, from where P has risen to P_d until the volume no longer falls
 *
 * The gas in the clearance volume V_c expands before suction. Valves have no mass and no resistance. Without valves the
 * gas is a spring, its energy K V^(1-n)/(n-1) + P_a V is stored.  With valves the stored energy is that released by the
 * enclosed gas down to the pressure of the suction line, at the volume V_s = V (P/P_s)^(1/n), and the work of that line
 * and of the other side,
 *
 *     E = (P V - P_s V_s)/(n - 1) - P_s V_s + P_a V,     dE/dV = P_a - P  while enclosed or in suction,
 *
 * so that compression and expansion dissipate nothing, and delivery n/(n-1) (P_d - P_s V_s/V) per volume delivered:
 * over a cycle the work of the compressor.  For n = 1 the first term is P V ln(P/P_s).  Below V_c/2, which only trial
 * motions reach, P continues along its tangent.
 *
 * Source: Dresig, Vul'fson, Dynamik der Mechanismen, 5.5.1 (compressor forces); any textbook of reciprocating
 * compressors.
 */
class GasForce : public DifferentiableElement<GasForce, 1, Branches, Structure>
{
public:
  struct Valves
  {
    double suction;  ///< P_s [Pa], > 0
    double delivery; ///< P_d [Pa], > P_s
  };

  struct Parameters
  {
    double area             = 0.;     ///< A [m^2], > 0
    double clearance_volume = 0.;     ///< V_c [m^3], > 0
    double dead_centre_at   = 0.;     ///< u_0 [m], u at V = V_c
    double exponent         = 1.3;    ///< n, >= 1
    double initial_pressure = 0.;     ///< P [Pa] at the start of the motion, > 0
    double back_pressure    = 101325; ///< P_a [Pa] on the other side of the piston, >= 0
    bool   grows            = true;   ///< s = 1

    std::optional<Valves> valves;
  };

  explicit GasForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number V      = volume(m.u[0]);
    const Branch branch = m.by_history ? branch_of(history) : branch_at(enclosed(value(V), history[1]));
    const Number P      = branch == closed ? enclosed(V, history[1]) : Number(line(branch));
    p[0]                = side() * parameters_.area * (P - parameters_.back_pressure);
  }

  /// V_c/2 [m^3]: below it, where no piston gets, the law continues along its tangent.
  double least_volume() const { return 0.5 * parameters_.clearance_volume; }

  void stiffest(const double *u, double *K, double *D) const override;

  /// history: active branch; K [Pa m^(3n)].
  int                   n_history() const override { return 2; }
  void                  start(const LocalMotion &motion, double *history) const override;
  void                  accept(const LocalMotion &motion, double *history) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  int                   n_guards(const double *history) const override;
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  enum Branch
  {
    suction  = -1,
    closed   = 0,
    delivery = 1
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[0])); }
  double        side() const { return parameters_.grows ? 1. : -1.; }
  double        line(Branch branch) const
  {
    return branch == suction ? parameters_.valves->suction : parameters_.valves->delivery;
  }
  Branch branch_at(double P) const
  {
    const auto &valves = parameters_.valves;
    return !valves ? closed : P > valves->delivery ? delivery : P < valves->suction ? suction : closed;
  }

  template <typename Number>
  Number volume(const Number &u) const
  {
    return parameters_.clearance_volume + side() * parameters_.area * (u - parameters_.dead_centre_at);
  }

  /// K V^-n
  template <typename Number>
  Number enclosed(const Number &V, double K) const
  {
    using std::pow;
    const double n = parameters_.exponent, least = least_volume();
    if (V < least)
      return K * std::pow(least, -n) * (1. - n * (V - least) / least);
    return K * pow(V, -n);
  }

  double pressure(const LocalMotion &motion, const double *history) const;
  /// E/V with valves, less P_a, of gas at the pressure P.
  double stored_with_valves(double P) const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
