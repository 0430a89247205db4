#pragma once

#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/lugre_friction.h"

namespace gestell::mechanism
{

/**
 * A friction law in an ideal joint with one DOF, a displacement [m], or an angle [rad] with the sliding radius r. Its
 * signals are those of JointFriction: the force on the motion, the speed of sliding.
 *
 * The law is that of the surface: coefficients [1], speeds [m/s], bristles per metre; for the angle they become
 *
 *     R = r mu,     v_s/r,     r^2 sigma_0,     r^2 sigma_1.
 *
 * Source: docs/theory/contact.md (4), (6), (7).
 */
template <class Law>
class FrictionInJoint : public Law
{
public:
  /// @param on_surface  forces per unit of the normal force
  /// @param radius      r [m]; 0: a displacement
  FrictionInJoint(const typename Law::Parameters &on_surface, const JointLoad &load, double radius)
      : Law(at_radius(on_surface, load, radius > 0. ? radius : 1.)), turns_(radius > 0.), lever_(turns_ ? radius : 1.)
  {
  }

  std::vector<Quantity> quantities() const override
  {
    auto own = Law::quantities();
    own[0]   = {"friction", turns_ ? "N m" : "N"};
    own[1]   = {"sliding_speed", "m/s"};
    return own;
  }
  double quantity(int i, const LocalMotion &motion, const double *history) const override
  {
    const double own = Law::quantity(i, motion, history);
    return i == 0 ? -own : lever_ * own;
  }

private:
  static CoulombFriction::Parameters at_radius(CoulombFriction::Parameters friction, const JointLoad &load, double r)
  {
    friction.kinetic_force *= r;
    friction.static_force *= r;
    friction.stribeck_speed /= r;
    friction.load = load;
    return friction;
  }
  static LuGreFriction::Parameters at_radius(LuGreFriction::Parameters friction, const JointLoad &load, double r)
  {
    friction.kinetic_force *= r;
    friction.static_force *= r;
    friction.stribeck_speed /= r;
    friction.bristle_stiffness *= r * r;
    friction.bristle_damping *= r * r;
    friction.load = load;
    return friction;
  }

  bool   turns_;
  double lever_;
};

} // namespace gestell::mechanism
