#pragma once

#include <utility>
#include <vector>

namespace gestell::fem
{

/// Linear combination  sum weight * value(index).
using Combination = std::vector<std::pair<int, double>>;

/**
 * Ties followed to values that are neither tied nor held, by deal.II's AffineConstraints: u = sum w_j v_j, where a v_j
 * that is tied itself is put in, and one that is held is zero.
 *
 * @param held, tie_of  of every displacement, as in MultipointConstraints
 * @throws std::invalid_argument if ties lead back to themselves.
 */
std::vector<Combination> closed_ties(const std::vector<char> &held, const std::vector<int> &tie_of,
                                     const std::vector<Combination> &ties);

} // namespace gestell::fem
