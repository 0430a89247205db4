#pragma once

#include "mechanism/elements/clearance.h"
#include "mechanism/sliding_friction.h"

namespace gestell::mechanism
{

/**
 * Journal in a bearing with radial clearance: a revolute joint with clearance.
 *
 * Measures: eccentricity y = (y1, y2) [m] of the journal normal to the axis, relative to the bearing, and its rotation
 * phi [rad] relative to the bearing about the axis e1 x e2.  With r = |y|, n = y/r, t = (-n2, n1) and the radius R of
 * the journal
 *
 *     p_y = -N n + T t,     p_phi = R T,     N = c d^n (1 + chi r'),     d = r - gap > 0,     N > 0,
 *     v_s = t . y' + R phi',                 T = -mu(|v_s|) N tanh(v_s/v0),
 *
 * with the normal law of Clearance, its branches and guards, and the friction of SlidingFriction.  v_s is the sliding
 * speed of the two surfaces at the contact.
 *
 * Source: P. Flores, J. Ambrosio, J. C. P. Claro, H. M. Lankarani, Kinematics and Dynamics of Multibody Systems with
 * Imperfect Joints, Springer 2008, chapter 3; docs/theory/contact.md (1).
 */
class JournalBearing : public DifferentiableElement<JournalBearing, 3, Branches, Structure>
{
public:
  struct Parameters
  {
    double          clearance   = 0.; ///< radial play [m], > 0
    double          radius      = 0.; ///< R [m], >= 0; needed for friction
    double          stiffness   = 0.; ///< c [N/m^n], > 0
    double          dissipation = 0.; ///< chi [s/m], >= 0
    double          exponent    = 1.; ///< n, >= 1
    SlidingFriction friction;
  };

  explicit JournalBearing(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    using std::sqrt;
    p[0] = p[1] = p[2] = Number(0.);
    const Number r2    = m.u[0] * m.u[0] + m.u[1] * m.u[1];
    if (!(value(r2) > 0.)) // centred: far from contact
      return;
    const Number r = sqrt(r2), n1 = m.u[0] / r, n2 = m.u[1] / r;
    const Number rate = n1 * m.v[0] + n2 * m.v[1];
    double       side;
    const Number N = normal_.pressure(Measures<Number>{m.t, &r, &rate, nullptr, m.by_history}, history, side);
    if (side == 0.)
      return;
    const double R    = parameters_.radius;
    const Number slip = n1 * m.v[1] - n2 * m.v[0] + R * m.v[2];
    const Number T    = -N * slip * parameters_.friction.factor(Number(slip * slip));
    p[0]              = -N * n1 - T * n2;
    p[1]              = -N * n2 + T * n1;
    p[2]              = R * T;
  }

  /// history: that of the normal contact.
  int  n_history() const override { return normal_.n_history(); }
  void start(const LocalMotion &motion, double *history) const override;
  void engaged(const double *u, double *K, double *D) const override;
  void open_branch(const double *, double *, double *) const override {}
  bool stiffens() const override { return normal_.stiffens(); }

  double             stored_energy(const LocalMotion &motion, const double *history) const override;
  double             stored_power(const LocalMotion &motion, const double *history) const override;
  double             penetration(const LocalMotion &motion) const override;
  Play               play(const double *u, const double *v, double *G) const override;
  double             yielding(double force) const override { return normal_.yielding(force); }
  int                n_guards(const double *history) const override { return normal_.n_guards(history); }
  std::vector<Guard> guards(const double *history) const override { return normal_.guards(history); }
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const Parameters &parameters() const { return parameters_; }

private:
  /// r, r' and the direction of the eccentricity; along e1 if the eccentricity is zero.
  struct Polar
  {
    explicit Polar(const LocalMotion &motion);
    LocalMotion motion(const LocalMotion &of) const { return {of.t, &r, &rate, nullptr, nullptr, of.by_history}; }

    double r, rate, n1, n2;
  };

  Parameters parameters_;
  Clearance  normal_;
};

} // namespace gestell::mechanism
