#pragma once

#include "fem/values/stress_recovery.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Stresses at the skin of a reduced frame, see fem::StressRecovery; empty unless requested.
 *
 *     sigma = mean [p; g],   g [3] the acceleration field (gravity).
 *
 * The columns of p contain the stresses of constraint modes (exact statics under interface loads) and of
 * fixed-interface modes (vibration). Those of g contain the static deflection under a unit field beyond the modes, so
 * that the stress under weight is also exact.
 */
struct ReducedStress
{
  std::vector<int>                point;     ///< [points] of the frame's picture
  std::vector<std::array<int, 3>> triangles; ///< into stress points
  std::vector<std::string>        rigid;     ///< supports and interfaces that make surfaces rigid
  std::vector<int>                nearby;    ///< [points] of `rigid`, or -1
  Eigen::MatrixXf                 mean;      // [6 points x (n1 + m + 3)] Pa
  Eigen::MatrixXf                 deviation; // same size: of a single element from the mean at its point

  bool empty() const { return point.empty(); }
  int  n_points() const { return static_cast<int>(point.size()); }
};

} // namespace gestell::coupling
