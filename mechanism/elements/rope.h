#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/one_sided_contact.h"

namespace gestell::mechanism
{

/**
 * Rope (chain, belt): a spring and damper in tension only. Measure u [m or rad]: increase of the distance of its ends
 * from the reference configuration; elongation d = u - slack:
 *
 *     d > 0 and c d + b u' > 0:   p = -(c d + b u'),        otherwise p = 0.
 *
 * A rope that contracts fast becomes slack before d = 0. With b > 0 the force begins with a jump. Events "taut" and
 * "slack".  The energy c d^2/2 is stored while d > 0, the rest is dissipated.
 */
class Rope : public DifferentiableElement<Rope, 1, OneSidedContact, Structure>
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
    const bool   taut         = m.by_history ? is_closed(history) : closes(value(m.u[0]), value(m.v[0]));
    p[0]                      = taut ? Number(-F) : Number(0.);
  }

  void engaged(const double *u, double *K, double *D) const override;
  void open_branch(const double *, double *, double *) const override {}

  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  std::string event(bool closing) const final { return closing ? "taut" : "slack"; }
  bool        closes(double u, double v) const final
  {
    const double d = u - parameters_.slack;
    return d > 0. && parameters_.stiffness * d + parameters_.damping * v > 0.;
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
