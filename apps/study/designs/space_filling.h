#pragma once

#include "apps/study/values/design.h"

#include <cstdint>

namespace gestell::apps
{

/**
 * Latin hypercube: every variable takes each of the n values -1 + (2 i + 1) / n once.  Of the hypercubes tried, by
 * exchange of two values of a variable at a time, the one with the smallest
 *
 *     phi = sum over pairs of d^-14,      d: distance of two points
 *
 * so that the smallest distance becomes large (maximin).
 *
 * @param n_runs at least 2
 * @throws std::invalid_argument (sizes)
 * Source: McKay, Beckman & Conover, Technometrics 21 (1979) 239-245; Morris & Mitchell, J. Stat. Plan. Inference 43
 * (1995) 381-402
 */
Design latin_hypercube(int n_variables, int n_runs, std::uint64_t seed);

/// Before the exchanges: at random.
Design random_latin_hypercube(int n_variables, int n_runs, std::uint64_t seed);

/// The smallest distance of two points of a design, in coded values.
double smallest_distance(const Eigen::MatrixXd &points);

/**
 * The first n points of Sobol's sequence, mapped from [0, 1) to [-1, 1): each dyadic interval of a variable holds
 * equally many of the first 2^m.  The first points of a longer design are those of a shorter one, so that a study can
 * be continued.
 *
 * @param seed 0: the sequence itself, whose first point is the corner -1; else shifted digit by digit by a random
 * number per variable, which keeps its evenness and makes its error measurable
 * @throws std::invalid_argument unless 1 <= k <= 1000, 1 <= n <= 2^30
 * Source: Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86-112; direction numbers of Boost.Random
 */
Design sobol_points(int n_variables, int n_runs, std::uint64_t seed = 0);

} // namespace gestell::apps
