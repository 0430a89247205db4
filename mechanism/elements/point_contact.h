#pragma once

#include "mechanism/elements/clearance.h"
#include "mechanism/sliding_friction.h"

namespace gestell::mechanism
{

/**
 * Contact of a point of one body with a plane of another, or with two parallel planes.
 *
 * Measures relative to the plane [m]: height s of the point along the normal, and its displacement (x, y) along the
 * plane.
 *
 *     p_s = normal force of a Clearance in s (Stops::below: the plane pushes up where s < -gap; both: two planes),
 *     (p_x, p_y) = -mu(|v|) |p_s| tanh(|v|/v0) v/|v|,     v = (x', y').
 *
 * Source: docs/theory/contact.md (2).
 */
class PointContact : public DifferentiableElement<PointContact, 3, Branches, Structure>
{
public:
  struct Parameters
  {
    Clearance::Parameters normal;
    SlidingFriction       friction;
  };

  explicit PointContact(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    double       side;
    const Number pressed = normal_.pressure(m, history, side);
    p[0] = p[1] = p[2] = Number(0.);
    if (side == 0.)
      return;
    p[0]                = -side * pressed;
    const Number factor = pressed * friction_.factor(Number(m.v[1] * m.v[1] + m.v[2] * m.v[2]));
    p[1]                = -factor * m.v[1];
    p[2]                = -factor * m.v[2];
  }

  /// history: that of the normal contact.
  int  n_history() const override { return normal_.n_history(); }
  void start(const LocalMotion &motion, double *history) const override { normal_.start(motion, history); }
  void engaged(const double *u, double *K, double *D) const override;
  void open_branch(const double *, double *, double *) const override {}
  bool stiffens() const override { return normal_.stiffens(); }

  double             stored_energy(const LocalMotion &motion, const double *history) const override;
  double             stored_power(const LocalMotion &motion, const double *history) const override;
  double             penetration(const LocalMotion &motion) const override { return normal_.penetration(motion); }
  Play               play(const double *u, const double *v, double *G) const override;
  double             yielding(double force) const override { return normal_.yielding(force); }
  int                n_guards(const double *history) const override { return normal_.n_guards(history); }
  std::vector<Guard> guards(const double *history) const override { return normal_.guards(history); }
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  const Clearance &normal() const { return normal_; }

private:
  Clearance       normal_;
  SlidingFriction friction_;
};

} // namespace gestell::mechanism
