#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace gestell::apps
{

/**
 * Vectors that change over time in short form: few shapes, whole numbers of 16 bits, and weights,
 *
 *     u(k) = sum_r weights(k, r) shapes(r),
 *
 * the singular vectors of all instants as far as they are needed.
 */
struct ShortMotion
{
  std::vector<std::vector<std::int16_t>> shapes;
  std::vector<float>                     weights; ///< [instants x shapes], row major

  std::size_t n_shapes() const { return shapes.size(); }
};

/// @param motion     [numbers x instants]
/// @param tolerance  in the unit of the motion: no column is farther off, in the root of its sum of squares
ShortMotion short_motion(const Eigen::MatrixXd &motion, double tolerance);

/**
 * Whether straight lines between instants tell a motion u(t): no point u_k is off the line from u_{k-1} to u_{k+1},
 * taken at its time t_k, by more than the tolerance.
 *
 * @param motion     [3 points x instants] m
 * @param times      [instants] s, ascending
 * @param tolerance  [m]
 */
bool is_straight(const Eigen::MatrixXd &motion, const std::vector<double> &times, double tolerance);

} // namespace gestell::apps
