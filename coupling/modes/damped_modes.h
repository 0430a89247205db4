#pragma once

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/system/second_order_system.h"

#include <vector>

namespace gestell::coupling
{

/// Damping ratios below this are rounding: B and C are sums of terms rounded to 1e-16.
constexpr double rounding_of_ratio = 1e-12;

/// A vibrating mode of the damped machine: omega = |s|, zeta = -Re s/|s|, and the undamped mode it is nearest to.
struct DampedMode
{
  SpectrumLine line;
  Eigen::Index nearest; ///< column of DenseModes::V
};

/// Tolerance of neglected mode coupling by dampers: relative errors of s, and of its real part.
struct CouplingTolerance
{
  double of_s, of_decay;
};

/**
 * Complex eigenvalues s of the undamped modes with the dampers between them, ascending in |s|; only those that vibrate:
 *
 *     (s^2 E + s B + diag(omega^2)) y = 0,     B = V^T B V [p x p], symmetric.
 *
 * Weakly coupled modes are solved separately: coupling of mode j with mode i moves its s by about
 *
 *     B_ij^2 s^2 / ((2 s + B_jj) (s^2 + B_ii s + omega_i^2))
 *
 * and couplings within the tolerance are neglected, the smallest first. Modes joined by the rest are solved together: a
 * frame with a few dashpots needs the time of its few coupled modes only.
 *
 * Source: docs/theory/stability.md, Damped modes.
 * @throws std::invalid_argument if an entry of B is not finite
 */
std::vector<DampedMode> damped_modes(const DenseModes &modes, const Eigen::MatrixXd &B,
                                     const CouplingTolerance &tolerance);

/**
 * The same with follower forces, all modes together: B and C refer to the dual basis of circulatory_modes() and are not
 * symmetric, with C in place of diag(omega^2).  A flutter has zeta < 0.
 */
std::vector<DampedMode> all_damped_modes(const DenseModes &modes, const Eigen::MatrixXd &C, const Eigen::MatrixXd &B);
/// All s of such a machine [2 p].
Eigen::VectorXcd damped_roots(const DenseModes &modes, const Eigen::MatrixXd &C, const Eigen::MatrixXd &B);

} // namespace gestell::coupling
