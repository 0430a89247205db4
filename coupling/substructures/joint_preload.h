#pragma once

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

/// Preload of a joint at rest by tightened tie rods, without other loads.
struct JointPreload
{
  std::string                 joint;
  Eigen::Matrix<double, 6, 1> on_second = Eigen::Matrix<double, 6, 1>::Zero(); ///< force and moment [N, N m]
  double                      pressed   = 0.; ///< [N] compressive normal force of a contact joint, with its own bolts
};

} // namespace gestell::coupling
