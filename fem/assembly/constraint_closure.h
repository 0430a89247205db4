#pragma once

#include <utility>
#include <vector>

namespace gestell::fem
{

/// Linear combination  sum weight * value(index).
using Combination = std::vector<std::pair<int, double>>;

/**
 * Resolves ties to values that are neither tied nor fixed, by deal.II's AffineConstraints: u = sum w_j v_j; a tied v_j
 * is substituted, a fixed one is zero.
 *
 * @param held, tie_of  of every displacement, as in MultipointConstraints
 * @throws std::invalid_argument for cyclic ties.
 */
std::vector<Combination> closed_ties(const std::vector<char> &held, const std::vector<int> &tie_of,
                                     const std::vector<Combination> &ties);

} // namespace gestell::fem
