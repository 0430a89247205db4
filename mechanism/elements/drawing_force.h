#pragma once

#include "mechanism/differentiable_element.h"

#include <limits>

namespace gestell::mechanism
{

/**
 * Force of deep drawing or other forming: it rises elastically, is constant while the sheet flows, and after unloading
 * acts again only near the largest path so far.
 *
 * Measure u [m]: displacement of the punch in feed direction; path z = u - x_T, with the plastic part z_p:
 *
 *     apart      z < z_p                  p = 0
 *     elastic    0 < c (z - z_p) < F      p = -c (z - z_p)
 *     flow       continued from there     p = -F,     z_p = z - F/c
 *
 * and p = 0 permanently once z has reached the depth while flowing, when the part is drawn through.  F/c is the elastic
 * path. The elastic energy is stored, the rest is dissipated.
 *
 * Source: elastic, perfectly plastic contact that never pulls; Dresig, Vul'fson, Dynamik der Mechanismen, 5.5.1.
 */
class DrawingForce : public DifferentiableElement<DrawingForce, 1, Branches, Structure>
{
public:
  struct Parameters
  {
    double force      = 0.;                                      ///< F [N], > 0
    double stiffness  = 0.;                                      ///< c [N/m], > 0
    double contact_at = 0.;                                      ///< x_T [m], u at which the punch touches
    double depth      = std::numeric_limits<double>::infinity(); ///< [m], above F/c
  };

  explicit DrawingForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number d      = elastic_force(Number(m.u[0] - parameters_.contact_at), history);
    const Branch branch = branch_for(m.by_history, history, value(d));
    p[0]                = branch == elastic ? Number(-d) : branch == flow ? Number(-parameters_.force) : Number(0.);
  }

  /// c, the stiffness of loading and unloading.
  void stiffest(const double *u, double *K, double *D) const override;

  /// history: z_p [m], active branch.
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
    apart,
    elastic,
    flow,
    through
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[1])); }
  /// The requested branch.
  Branch branch_for(bool by_history, const double *history, double elastic_force) const
  {
    return by_history ? branch_of(history) : branch_at(elastic_force, history);
  }
  Branch branch_at(double elastic_force, const double *history) const
  {
    return branch_of(history) == through        ? through
           : elastic_force <= 0.                ? apart
           : elastic_force <= parameters_.force ? elastic
                                                : flow;
  }
  /// c (z - z_p)
  template <typename Number>
  Number elastic_force(const Number &z, const double *history) const
  {
    return parameters_.stiffness * (z - history[0]);
  }
  double path(const LocalMotion &motion) const { return motion.u[0] - parameters_.contact_at; }
  double rise() const { return parameters_.force / parameters_.stiffness; }
  bool   ends() const { return parameters_.depth < std::numeric_limits<double>::infinity(); }

  Parameters parameters_;
};

} // namespace gestell::mechanism
