#pragma once

#include "mechanism/stribeck.h"

#include <cmath>
#include <string>

namespace gestell::mechanism
{

/**
 * Coefficient of friction of a contact, smoothed near rest: for a normal force N and the sliding velocity v (a number,
 * or a vector in the plane of contact)
 *
 *     F = -mu(|v|) N tanh(|v|/v0) v/|v|,       mu(v) a Stribeck curve (mechanism/stribeck.h).
 *
 * Sticking is replaced by slow creep of order v0.
 */
struct SlidingFriction
{
  double kinetic            = 0.;   ///< mu [1], >= 0; 0: none
  double speed              = 1e-3; ///< v0 [m/s], > 0
  double static_coefficient = 0.;   ///< mu0 [1], >= mu; unused without a Stribeck speed
  double stribeck_speed     = 0.;   ///< v_s [m/s], >= 0; 0: none
  double stribeck_exponent  = 1.;   ///< 1 or 2

  void check(const std::string &name) const
  {
    require(std::isfinite(kinetic) && kinetic >= 0., name, "friction", kinetic, "zero or positive");
    require(std::isfinite(speed) && speed > 0., name, "friction_speed [m/s]", speed, "positive");
    require(std::isfinite(stribeck_speed) && stribeck_speed >= 0., name, "stribeck_speed [m/s]", stribeck_speed,
            "zero or positive");
    require(stribeck_speed == 0. || static_coefficient >= kinetic, name, "static_friction", static_coefficient,
            "at least the kinetic one, " + std::to_string(kinetic));
    require(stribeck_exponent == 1. || stribeck_exponent == 2., name, "stribeck_exponent", stribeck_exponent, "1 or 2");
  }

  /// F = -factor N v, from |v|^2: finite at rest, where |v| is at least 1e-6 v0 (1e-12 relative).
  template <typename Number>
  Number factor(const Number &v_squared) const
  {
    using std::sqrt, std::tanh;
    const double   least = 1e-6 * speed;
    const Number   v     = sqrt(Number(v_squared + least * least));
    const Stribeck curve{kinetic, stribeck_speed > 0. ? static_coefficient : kinetic, stribeck_speed,
                         stribeck_exponent};
    return curve.force(v) * tanh(Number(v / speed)) / v;
  }
};

} // namespace gestell::mechanism
