#include "coupling/integration/second_order_system.h"

namespace gestell::coupling
{

void LocalState::resize(Eigen::Index n_u)
{
  for (Eigen::VectorXd *x : {&u, &v, &a, &p})
    x->setZero(n_u);
  lambda.resize(0);
}

void LocalState::resize(const SecondOrderSystem &system)
{
  resize(system.directions().cols());
  lambda.setZero(system.n_constraints());
}

bool SecondOrderSystem::dense_matrices(Eigen::MatrixXd &, Eigen::MatrixXd &, Eigen::MatrixXd &) const
{
  return false;
}

bool SecondOrderSystem::sparse_matrices(Eigen::SparseMatrix<double> &, Eigen::SparseMatrix<double> &,
                                        Eigen::SparseMatrix<double> &) const
{
  return false;
}

const std::vector<ForceBlock> &SecondOrderSystem::force_blocks() const
{
  static const std::vector<ForceBlock> none;
  return none;
}

void SecondOrderSystem::local_tangent_blocks(const LocalState &state, double, double, double, Eigen::VectorXd &p,
                                             Eigen::VectorXd &) const
{
  local_force(state, p);
}

const std::vector<HeldMeasure> &SecondOrderSystem::held() const
{
  static const std::vector<HeldMeasure> none;
  return none;
}

const std::vector<int> &SecondOrderSystem::virtual_coordinates() const
{
  static const std::vector<int> none;
  return none;
}

const std::vector<ConstraintBlock> &SecondOrderSystem::constraint_blocks() const
{
  static const std::vector<ConstraintBlock> none;
  return none;
}

void SecondOrderSystem::constraints(const LocalState &, Eigen::VectorXd &g, ConstraintJacobian &) const
{
  g.setZero();
}

void SecondOrderSystem::constraint_rates(const LocalState &, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const
{
  rate.setZero();
  bias.setZero();
}

std::string SecondOrderSystem::constraint_name(int i) const
{
  return "constraint " + std::to_string(i + 1);
}

} // namespace gestell::coupling
