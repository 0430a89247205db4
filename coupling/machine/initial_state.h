#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Where a run begins.
struct InitialState
{
  double          t = 0.;
  Eigen::VectorXd q, v;            // [n]
  bool            settled = false; ///< in equilibrium: contacts are closed by the forces they carry

  std::vector<std::string> notes{}; ///< what a user should know of how it was found

  double still = 0.; ///< [m/s, rad/s] sliding speed that is none: see EventOptions
};

} // namespace gestell::coupling
