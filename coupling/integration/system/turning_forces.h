#pragma once

#include "coupling/integration/system/local_forces.h"

namespace gestell::coupling
{

/// Interface of LocalForces and IdealJoints whose forces act along directions that rotate with the motion:
/// LocalForces::derivatives() keeps these directions constant, in the forces and in the rates they depend on, which
/// suffices for a step of Newton's method.
class TurningForces
{
public:
  virtual ~TurningForces() = default;

  /// dp/du [n_u x n_u] += the terms neglected by the derivatives.
  virtual void add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const = 0;
};

/// p, dp/du and dp/dv like LocalForces::derivatives(), but with rotating directions, so that dp/du need not be
/// symmetric: for results that are derivatives themselves, such as vibrations about a motion and multipliers of a
/// periodic solution.
inline void linearise(const LocalForces &forces, const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                      Eigen::MatrixXd &dp_dv)
{
  forces.derivatives(state, p, dp_du, dp_dv);
  if (const auto *turning = dynamic_cast<const TurningForces *>(&forces))
    turning->add_turning(state, dp_du);
}

} // namespace gestell::coupling
