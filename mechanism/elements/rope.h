#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Rope (chain, belt): a spring and damper that only pulls.
 *
 * Measure u [m or rad], by which its ends are further apart than in the drawing; elongation d = u - slack:
 *
 *     d > 0 and c d + b u' > 0:   p = -(c d + b u'),        otherwise p = 0.
 *
 * A rope that contracts faster than it can follow is slack before d = 0.  With b > 0 the force sets in with a jump.
 * Events "taut" and "slack".  Stored is c d^2/2 while d > 0, the rest is dissipated.
 */
class Rope : public DifferentiableElement<Rope, 1>
{
public:
  struct Parameters
  {
    double stiffness = 0.; ///< c [N/m or N m/rad], > 0
    double damping   = 0.; ///< b [N s/m or N m s/rad], >= 0
    double slack     = 0.; ///< [m or rad], u at which it becomes taut; negative: taut at u = 0
  };

  explicit Rope(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const auto &[c, b, slack] = parameters_;
    const Number F            = c * (m.u[0] - slack) + b * m.v[0];
    const bool   taut         = m.by_history ? history[0] != 0. : value(m.u[0]) > slack && value(F) > 0.;
    p[0]                      = taut ? Number(-F) : Number(0.);
  }

  void engaged(const double *u, double *K, double *D) const override;
  void open_branch(const double *, double *K, double *D) const override { no_structure(K, D); }

  /// history: 1 taut, 0 slack.
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
};

} // namespace gestell::mechanism
