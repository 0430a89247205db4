#include "coupling/integration/second_order_system.h"

namespace gestell::coupling
{

bool SecondOrderSystem::dense_matrices(Eigen::MatrixXd &, Eigen::MatrixXd &, Eigen::MatrixXd &) const
{
  return false;
}

const std::vector<HeldMeasure> &SecondOrderSystem::held() const
{
  static const std::vector<HeldMeasure> none;
  return none;
}

void SecondOrderSystem::constraints(double, const Eigen::VectorXd &, Eigen::VectorXd &g) const
{
  g.resize(0);
}

void SecondOrderSystem::constraint_jacobian(double, const Eigen::VectorXd &, Eigen::MatrixXd &G) const
{
  G.resize(0, size());
}

} // namespace gestell::coupling
