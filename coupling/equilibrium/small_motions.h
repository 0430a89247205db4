#pragma once

#include "coupling/equilibrium/static_balance.h"

#include <string>

namespace gestell::coupling
{

/// Small motions q = Z y about a position at rest, Z^T M Z y'' + K y = 0.
struct SmallMotions
{
  Eigen::MatrixXd Z;                   ///< [n x m] motions that joints allow; virtual coordinates are fixed
  Eigen::MatrixXd K;                   ///< [m x m]
  bool            circulatory = false; ///< with follower forces: K is not symmetric
};

/// @param C  [n x n] the stiffness of `balance` at its last evaluation; for conservative forces only its symmetric part
///   is used
SmallMotions small_motions(StaticBalance &balance, const Eigen::MatrixXd &C);

/// A motion that leaves an equilibrium.
struct Growth
{
  double          rate = 0.; ///< [1/s] of exp(rate t), without damping
  double          hz   = 0.; ///< of a flutter by follower forces; 0: a divergence
  Eigen::VectorXd motion;    ///< [n]

  bool        falls() const { return rate > 0. && hz == 0.; }
  std::string text(const Machine &machine) const; ///< "the motion of slide grows by exp(3 t/s)"
};

/// The fastest diverging motion; if there is none, the fastest flutter.
/// @param M  [n x n]
Growth fastest_growth(const SmallMotions &motions, const Eigen::MatrixXd &M);

} // namespace gestell::coupling
