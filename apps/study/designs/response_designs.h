#pragma once

#include "apps/study/values/design.h"

#include <vector>

namespace gestell::apps
{

/// Every combination of these coded levels, the last variable fastest.
/// @throws std::invalid_argument for no variables, one without levels, or more than 1e6 runs
Design full_factorial(const std::vector<std::vector<double>> &levels);

/// `n` levels from -1 to 1, evenly.  @throws std::invalid_argument for less than 2
std::vector<double> even_levels(int n);

/// How far the star points of a central composite design of k variables lie from its centre.
enum class Star
{
  rotatable,    ///< alpha = F^(1/4): the variance of the fit depends on the distance from the centre alone
  face_centred, ///< alpha = 1: three levels, nothing outside the range
  orthogonal,   ///< alpha^2 = (sqrt(N F) - F) / 2: the squares, less their means, are orthogonal
  spherical     ///< alpha = sqrt(k): all points but the centre on one sphere
};

/// alpha for F = 2^k corners and N = F + 2 k + centre points.
double star_distance(Star star, int n_variables, int centre_points);

/**
 * 2^k corners, 2 k star points (+-alpha on one axis), then the centre points.  24 runs for k = 4 without centre points.
 * @throws std::invalid_argument unless 1 <= k <= 12, alpha > 0, centre points >= 0
 * Source: Box & Wilson, J. R. Stat. Soc. B 13 (1951) 1-45; docs/theory/response_surfaces.md (2)
 */
Design central_composite(int n_variables, double alpha, int centre_points);

/**
 * Corners of two (k = 3, 4, 5) or three (k = 6, 7) variables at a time, the others at their centres; no run has all
 * variables at their ends.
 * @throws std::invalid_argument unless 3 <= k <= 7, centre points >= 0
 * Source: Box & Behnken, Technometrics 2 (1960) 455-475
 */
Design box_behnken(int n_variables, int centre_points);

} // namespace gestell::apps
