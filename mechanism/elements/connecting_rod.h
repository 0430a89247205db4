#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Elastic connecting rod with clearance between a crank pin and a slide, along the slide's axis e.
 *
 * Measures (phi, s, y): crank angle from top dead centre [rad]; s = e. (x_crank - x_slide) [m]; y, the same difference
 * normal to e in the crank's plane [m].  The position function of the slide is
 *
 *     u(phi, y) = -r cos phi + w - (l - r),     w = sqrt(l^2 - c^2),   c = r sin phi + y,       u(0, 0) = 0,
 *
 * the compression of the chain delta = u(phi, y) + s, its rate delta' = u_phi phi' + u_y y' + s'.
 * Force along e, compression positive, three branches, continuous (kinks at delta = 0 and delta = -s_cl):
 *
 *     delta > 0               F = b_O delta' + c delta + b [1 - exp(-delta/p0)] delta'
 *     -s_cl <= delta <= 0     F = b_O delta'
 *     delta < -s_cl           F = b_O delta' - c e + b [1 - exp(-e/p0)] delta',     e = -(delta + s_cl)
 *
 * Generalised forces by virtual work: p = -F grad delta; the component on y is F tan(psi), the lateral force of the rod
 * on crank and slide.  The force along the rod is F / cos(psi), sin(psi) = c/l.
 *
 * Source: reference model of the crank press, sections 2 and 3; docs/theory/elements.md.
 */
class ConnectingRod : public DifferentiableElement<ConnectingRod, 3, Branches, Structure>
{
public:
  struct Parameters
  {
    double crank_radius   = 0.;   ///< r [m], > 0
    double length         = 0.;   ///< l [m], > r
    double stiffness      = 0.;   ///< c [N/m], > 0, of the closed chain
    double damping        = 0.;   ///< b [N s/m], >= 0, of the closed chain
    double closing_length = 1e-4; ///< p0 [m], > 0, over which b increases to its value
    double clearance      = 0.;   ///< s_cl [m], >= 0, total clearance
    double oil_damping    = 0.;   ///< b_O [N s/m], >= 0, acts in all branches
  };

  explicit ConnectingRod(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    Number       gradient[3];
    const Number delta = compression(m.u, gradient);
    const Number rate  = gradient[0] * m.v[0] + gradient[1] * m.v[1] + gradient[2] * m.v[2];
    const Number push  = chain_force(branch_for(m.by_history, history, value(delta)), delta, rate);
    for (int i = 0; i < 3; ++i)
      p[i] = -push * gradient[i];
  }

  /// history: active branch.
  int    n_history() const override { return 1; }
  void   start(const LocalMotion &motion, double *history) const override;
  void   engaged(const double *u, double *K, double *D) const override;
  void   open_branch(const double *u, double *K, double *D) const override; ///< the oil film
  bool   closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const override;
  Play   play(const double *u, const double *v, double *G) const override;
  double yielding(double force) const override { return std::abs(force) / parameters_.stiffness; }
  double size_of_terms() const override { return parameters_.crank_radius + parameters_.length; }
  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;

  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const Parameters &parameters() const { return parameters_; }

private:
  enum Branch
  {
    compressed,
    gap,
    pulled
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[0])); }
  /// The requested branch.
  Branch branch_for(bool by_history, const double *history, double delta) const
  {
    return by_history ? branch_of(history) : branch_at(delta);
  }
  Branch branch_at(double delta) const
  {
    return delta > 0. ? compressed : delta < -parameters_.clearance ? pulled : gap;
  }

  /// F(delta, delta') of one branch, also beyond its ends.
  template <typename Number>
  Number chain_force(Branch branch, const Number &delta, const Number &rate) const
  {
    const auto &[r, l, c, b, p0, s_cl, b_O] = parameters_;
    if (branch == compressed)
      return b_O * rate + c * delta + b * fade_in(Number(delta / p0)) * rate;
    if (branch == pulled)
    {
      const Number e = -(delta + s_cl);
      return b_O * rate - c * e + b * fade_in(Number(e / p0)) * rate;
    }
    return b_O * rate;
  }

  /// 1 - exp(-x); far below the switching point x = 0, which only trial motions reach, its tangent at x = -1: finite.
  template <typename Number>
  static Number fade_in(const Number &x)
  {
    using std::exp;
    if (x < -1.)
      return 1. + std::exp(1.) * x;
    return 1. - exp(-x);
  }

  /// delta(phi, s, y) and its gradient.
  template <typename Number>
  Number compression(const Number *u, Number *gradient) const
  {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const double r = parameters_.crank_radius, l = parameters_.length;
    const Number sine = sin(u[0]), cosine = cos(u[0]);
    const Number c = r * sine + u[2];
    const Number w = sqrt(Number(l * l - c * c));
    gradient[0]    = r * sine - r * c * cosine / w;
    gradient[1]    = Number(1.);
    gradient[2]    = -c / w;
    return -r * cosine + w - (l - r) + u[1];
  }

  double rate(const LocalMotion &motion) const;
  double deflection(const LocalMotion &motion, const double *history) const;
  /// K and D of a spring and a damper along the chain.
  void chain_matrices(const double *u, double stiffness, double damping, double *K, double *D) const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
