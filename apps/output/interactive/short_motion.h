#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace gestell::apps
{

/**
 * Compressed vectors over time: few shapes, 16-bit integers, and weights,
 *
 *     u(k) = sum_r weights(k, r) shapes(r),
 *
 * from the instants that span all others within a tolerance.
 */
struct ShortMotion
{
  std::vector<std::vector<std::int16_t>> shapes;
  std::vector<float>                     weights; ///< [instants x shapes], row major

  std::size_t n_shapes() const { return shapes.size(); }
};

/// @param motion     [numbers x instants]
/// @param tolerance  in the unit of the motion: limit of the error of every column, as root of the sum of squares
ShortMotion short_motion(const Eigen::MatrixXd &motion, double tolerance);

/**
 * Whether linear interpolation between instants reproduces a motion u(t): no point u_k differs by more than the
 * tolerance from the line between u_{k-1} and u_{k+1} at its time t_k.
 *
 * @param motion     [3 points x instants] m
 * @param times      [instants] s, ascending
 * @param tolerance  [m]
 */
bool is_straight(const Eigen::MatrixXd &motion, const std::vector<double> &times, double tolerance);

} // namespace gestell::apps
