#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Initial state of a run.
struct InitialState
{
  double          t = 0.;
  Eigen::VectorXd q, v;            // [n]
  bool            settled = false; ///< in equilibrium: contacts are closed by their forces

  std::vector<std::string> notes{}; ///< how it was found, for the user

  Eigen::VectorXd acceleration{}; ///< [n] of a floating machine whose inertia balances its loads; empty: none

  double still = 0.; ///< [m/s, rad/s] sliding speed treated as zero: see EventOptions
};

} // namespace gestell::coupling
