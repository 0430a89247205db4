#pragma once

#include "coupling/integration/system/local_forces.h"

namespace gestell::coupling
{

/// What forces have besides that act along directions which turn with the motion: LocalForces::derivatives() holds
/// these directions, in the forces and in the rates they depend on, which is enough for a step of Newton's method.
class TurningForces
{
public:
  virtual ~TurningForces() = default;

  /// dp/du [n_u x n_u] += what the derivatives have left out.
  virtual void add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const = 0;
};

/// p, dp/du and dp/dv as LocalForces::derivatives(), directions not held, so that dp/du need not be symmetric: for
/// answers that are derivatives themselves, such as vibrations about a motion and multipliers of a periodic one.
inline void linearise(const LocalForces &forces, const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                      Eigen::MatrixXd &dp_dv)
{
  forces.derivatives(state, p, dp_du, dp_dv);
  if (const auto *turning = dynamic_cast<const TurningForces *>(&forces))
    turning->add_turning(state, dp_du);
}

} // namespace gestell::coupling
