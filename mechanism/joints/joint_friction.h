#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/joint_load.h"
#include "mechanism/sliding_friction.h"

#include <array>
#include <cmath>

namespace gestell::mechanism
{

/**
 * Friction in an ideal joint, by its constraint forces. Measures: the k free motions s of the joint, displacements [m],
 * or angles [rad] with the sliding radius r_i (r_i = 1 for displacements), and
 *
 *     p_i = -r_i mu(|v|) N tanh(|v|/v0) v_i/|v|,   v_i = r_i s_i',   N of JointLoad.
 *
 * For a ball joint the three are only rates of rotation (RelativeMeasure, spin).  The law reads multipliers from
 * LocalMotion; its tangent keeps them constant.
 *
 * Source: docs/theory/contact.md (4), (4a).
 */
template <int k>
class JointFriction : public DifferentiableElement<JointFriction<k>, k>
{
public:
  struct Parameters
  {
    SlidingFriction       friction;
    std::array<double, k> radii{}; ///< r_i [m] of the sliding surface; 0: s_i is a displacement, r_i = 1
    JointLoad             load;
  };

  explicit JointFriction(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    Number v2(0.);
    for (int i = 0; i < k; ++i)
      v2 = v2 + (lever(i) * lever(i)) * m.v[i] * m.v[i];
    const Number factor = parameters_.load.normal_force(m.lambda) * parameters_.friction.factor(v2);
    for (int i = 0; i < k; ++i)
      p[i] = -(lever(i) * lever(i)) * factor * m.v[i];
  }

  /// "friction", for a single motion with its sign; a torque if all are rotations, else the force.
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  double lever(int i) const { return parameters_.radii[i] > 0. ? parameters_.radii[i] : 1.; }
  bool   turns() const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
