#pragma once

#include "fem/values/stress_recovery.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Stresses at the skin of a reduced frame, see fem::StressRecovery; empty unless they were asked for.
 *
 *     sigma = mean [p; g],   g [3] the acceleration field (gravity).
 *
 * The columns of p hold the stresses of constraint modes and of fixed-interface modes: loads at the interfaces are
 * carried statically exactly, vibrations by the kept modes.  Those of g hold what the static deflection under a unit
 * field has beyond the modes, so that the stress of the weight is exact as well.
 */
struct ReducedStress
{
  std::vector<int>                point;     ///< [points] of the frame's picture
  std::vector<std::array<int, 3>> triangles; ///< into stress points
  std::vector<std::string>        rigid;     ///< supports and interfaces that hold surfaces rigid
  std::vector<int>                nearby;    ///< [points] of `rigid`, or -1
  Eigen::MatrixXf                 mean;      // [6 points x (n1 + m + 3)] Pa
  Eigen::MatrixXf                 deviation; // the same: of one cell from the mean of the cells at its point

  bool empty() const { return point.empty(); }
  int  n_points() const { return static_cast<int>(point.size()); }
};

} // namespace gestell::coupling
