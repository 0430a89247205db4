#pragma once

#include "coupling/frame/stress_field.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

struct StressPeak
{
  int    point     = -1; ///< -1: no point is included
  int    state     = -1; ///< column
  double von_mises = 0.; ///< [Pa]
};

/// State and point of the largest sigma_v, and the number of evaluated points.
struct StressSearch
{
  StressPeak peak;
  int        looked_at = 0;
};

/**
 * The largest sigma_v of many states, without computing every stress of every state.
 *
 * sigma_v is a seminorm |L sigma| of the stress, with the rows A_i = L S_i of point i one of the state z.  With any
 * basis, z(t) = sum_r b_r c_r(t), the triangle inequality bounds it over all times:
 *
 *     max_t sigma_v,i(t)  <=  sum_r |A_i b_r| max_t |c_r(t)|.
 *
 * The b_r are the principal components of the states in the norm z^T S^T S z, few of which contain most of the motion,
 * so that the bound is tight; parts below rounding in that norm, scaled by the largest coordinates, are added direction
 * by direction. Points are evaluated in the order of their bounds until the largest remaining bound is below the
 * maximum found: the result is exact over all states.
 *
 * @param states  (p; g) [n1 + m + 3 x k], k >= 1
 * @param counts  [points]
 */
StressSearch largest_von_mises(const ReducedStress &stress, const Eigen::MatrixXd &states,
                               const std::vector<char> &counts);

} // namespace gestell::coupling
