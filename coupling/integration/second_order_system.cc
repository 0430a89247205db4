#include "coupling/integration/second_order_system.h"

namespace gestell::coupling
{

void SecondOrderSystem::constraints(double, const Eigen::VectorXd &, Eigen::VectorXd &g) const
{
  g.resize(0);
}

void SecondOrderSystem::constraint_jacobian(double, const Eigen::VectorXd &, Eigen::MatrixXd &G) const
{
  G.resize(0, size());
}

} // namespace gestell::coupling
