#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gestell::mechanism
{

/**
 * Force of sliding friction over the sliding speed v >= 0, which falls from the static force to the kinetic one:
 *
 *     R(v) = R + (R0 - R) exp(-(v/v_s)^delta),        R(v) = R for v_s = 0.
 *
 * Source: B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit, Automatica 30 (1994) 1083-1138.
 */
struct Stribeck
{
  double kinetic_force = 0.; ///< R [N or N m], >= 0
  double static_force  = 0.; ///< R0 [N or N m], >= R
  double speed         = 0.; ///< v_s [m/s or rad/s], >= 0
  double exponent      = 1.; ///< delta, 1 (Tustin) or 2 (Gauss)

  void check(const std::string &name) const
  {
    require(std::isfinite(kinetic_force) && kinetic_force >= 0., name, "kinetic_force [N]", kinetic_force,
            "zero or positive");
    require(std::isfinite(static_force) && static_force >= kinetic_force, name, "static_force [N]", static_force,
            "at least the kinetic force, " + std::to_string(kinetic_force) + " N");
    require(std::isfinite(speed) && speed >= 0., name, "stribeck_speed [m/s]", speed, "zero or positive");
    require(exponent == 1. || exponent == 2., name, "stribeck_exponent", exponent, "1 or 2");
  }

  /// R(v); for v < 0 (trial motions only) its tangent at v = 0.
  template <typename Number>
  Number force(const Number &v) const
  {
    using std::exp;
    if (speed == 0.)
      return Number(kinetic_force);
    const Number x    = v / speed;
    const double drop = static_force - kinetic_force;
    if (x < 0.)
      return exponent == 1. ? Number(kinetic_force + drop * (1. - x)) : Number(static_force);
    return exponent == 1. ? Number(kinetic_force + drop * exp(-x)) : Number(kinetic_force + drop * exp(-x * x));
  }
};

} // namespace gestell::mechanism
