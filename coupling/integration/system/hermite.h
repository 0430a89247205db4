#pragma once

#include <array>

namespace gestell::coupling
{

/// Interpolation weights at t for values (and slopes) at up to three instants.
struct InterpolationWeights
{
  int                   n = 0;
  std::array<double, 3> value{}, slope{};           ///< Hermite: f(t)  = sum value f_i + slope f'_i
  std::array<double, 3> rate_value{}, rate_slope{}; ///< its derivative f'(t)
  std::array<double, 3> lagrange{};                 ///< f(t) from values alone
};

/// Hermite interpolation through n = 2 or 3 points t_i (order 2 n) and Lagrange's through the same (order n).
InterpolationWeights hermite_weights(const double *t_i, int n, double t);

} // namespace gestell::coupling
