#pragma once

#include "coupling/algebra/dense_modes.h"

namespace gestell::coupling
{

/// `cancelled` of dense_modes() for matrices accurate to rounding.
constexpr double cancelled_by_rounding = 1e-12;

/// Modes exp(s t) of a C that is not symmetric.
struct CirculatoryModes
{
  /// omega = |Im s|, growth = Re s: a flutter is a pair of equal omega, one with growth > 0 and one with growth < 0;
  /// its two columns of V span the plane of its motion.
  DenseModes      modes;
  Eigen::MatrixXd left; ///< [n x p] rows of the dual basis: left^T M V = E
};

/**
 * The same as dense_modes() of a C that is not symmetric, as by follower (circulatory) forces:
 *
 *     (C - lambda M) v = 0,     s^2 = -lambda,
 *
 * with lambda > 0 a vibration, lambda < 0 a divergence, a complex pair a flutter.  The solved problem is  (C + s M)^-1
 * M v = v/(lambda + s)  with an s that makes the symmetric part of C + s M positive definite, so that it is regular; M
 * may be singular.
 *
 * Source: H. Ziegler, Principles of Structural Stability, 1968; docs/theory/modes_along.md (9).
 * @throws std::invalid_argument as dense_modes() does
 */
CirculatoryModes circulatory_modes(const Eigen::MatrixXd &C, const Eigen::MatrixXd &M);

} // namespace gestell::coupling
