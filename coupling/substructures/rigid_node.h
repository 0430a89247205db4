#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/// Motion of a node at x that is rigidly connected to one at x0:  u = u0 + theta x (x - x0), as a matrix.
inline Eigen::Matrix<double, 6, 6> carried(const Eigen::Vector3d &x0, const Eigen::Vector3d &x)
{
  const Eigen::Vector3d       r = x - x0;
  Eigen::Matrix<double, 6, 6> R = Eigen::Matrix<double, 6, 6>::Identity();
  R.topRightCorner<3, 3>() << 0., r[2], -r[1], //
      -r[2], 0., r[0],                         //
      r[1], -r[0], 0.;
  return R;
}

} // namespace gestell::coupling
