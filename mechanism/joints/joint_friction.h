#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/sliding_friction.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Friction in an ideal joint, by the forces that close it.
 *
 * Measures: the k motions s that the joint leaves free, displacements [m], or an angle [rad] that slides at the radius
 * r (r = 1 for displacements).  Of its multipliers the first n_F are forces, the next n_M torques, and
 *
 *     p = -r mu(|v|) N tanh(|v|/v0) v/|v|,   v = r s',   N = max(|lambda_F|, 2 |lambda_M|/L).
 *
 * Torques count where a guide of length L takes them by two opposite forces at its ends: |F/2 + M/L| + |F/2 - M/L| is
 * that maximum.  The law sees multipliers in LocalMotion; its tangent holds them.
 *
 * Source: docs/theory/contact.md (4).
 */
template <int k>
class JointFriction : public DifferentiableElement<JointFriction<k>, k>
{
public:
  struct Parameters
  {
    SlidingFriction friction;
    double          radius   = 0.;               ///< r [m] of the surface that slides; 0: s are displacements, r = 1
    int             n_forces = 0, n_torques = 0; ///< n_F, n_M
    double          length = 0.;                 ///< L [m], >= 0; 0: torques make no friction
  };

  explicit JointFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    const double r = lever(), N = normal_force(m.lambda);
    Number       v2(0.);
    for (int i = 0; i < k; ++i)
      v2 = v2 + (r * r) * m.v[i] * m.v[i];
    const Number factor = (r * r * N) * parameters_.friction.factor(v2);
    for (int i = 0; i < k; ++i)
      p[i] = -factor * m.v[i];
  }

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  double lever() const { return parameters_.radius > 0. ? parameters_.radius : 1.; }
  /// N; 0 where multipliers are unknown.
  double normal_force(const double *lambda) const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
