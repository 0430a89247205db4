#pragma once

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gestell::mechanism
{

/**
 * Normal force of an ideal joint from its multipliers: the first n_F are forces, the next n_M torques,
 *
 *     N = max(|lambda_F|, 2 |lambda_M|/L).
 *
 * A guide of length L transmits torques by two opposite forces at its ends: |F/2 + M/L| + |F/2 - M/L| is this maximum.
 *
 * Source: docs/theory/contact.md (4).
 */
struct JointLoad
{
  int    n_forces = 0, n_torques = 0; ///< n_F >= 1, n_M
  double length = 0.;                 ///< L [m], >= 0; 0: torques cause no friction

  void check(const std::string &name) const
  {
    require(std::isfinite(length) && length >= 0., name, "length [m]", length, "zero or positive");
    require(n_forces > 0, name, "number of forces", n_forces, "one or more");
  }

  /// N [N]; 0 if multipliers are unknown.
  double normal_force(const double *lambda) const
  {
    if (!lambda)
      return 0.;
    double forces = 0., torques = 0.;
    for (int i = 0; i < n_forces; ++i)
      forces += lambda[i] * lambda[i];
    for (int i = n_forces; length > 0. && i < n_forces + n_torques; ++i)
      torques += lambda[i] * lambda[i];
    return std::max(std::sqrt(forces), length > 0. ? 2. / length * std::sqrt(torques) : 0.);
  }
};

} // namespace gestell::mechanism
