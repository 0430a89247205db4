#pragma once

#include <Eigen/Core>

#include <array>

namespace gestell::coupling
{

/// Weights with which values (and slopes) at up to three points of time give a value at t.
struct InterpolationWeights
{
  int                   n = 0;
  std::array<double, 3> value{}, slope{};           ///< Hermite: f(t)  = sum value f_i + slope f'_i
  std::array<double, 3> rate_value{}, rate_slope{}; ///< its derivative f'(t)
  std::array<double, 3> lagrange{};                 ///< f(t) from values alone
};

/// Hermite interpolation through n = 2 or 3 points t_i (order 2 n) and Lagrange's through the same (order n).
InterpolationWeights hermite_weights(const double *t_i, int n, double t);

/**
 * Hermite's interpolation of a motion x and of its rate.  Rounding of x_i grows in the rate by the inverse of the step,
 *
 *     |error| <= roundings eps sum |rate_value_i x_i|;
 *
 * a rate that differs by no more from that interpolated by the rates alone is replaced by the latter, component by
 * component: of steps so short the rates tell more.
 *
 * @param weights  of n points
 * @param x_i      values at these points, of the size of x
 * @param rate_i   rates there
 */
void interpolate_motion(const InterpolationWeights &weights, const std::array<const double *, 3> &x_i,
                        const std::array<const double *, 3> &rate_i, Eigen::Ref<Eigen::VectorXd> x,
                        Eigen::Ref<Eigen::VectorXd> rate);

} // namespace gestell::coupling
