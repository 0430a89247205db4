#include "coupling/integration/system/second_order_system.h"

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
  resize(system.forces().directions().cols());
  lambda.setZero(system.joints().n_rows());
}

Eigen::Index tangent_size(const std::vector<ForceBlock> &blocks)
{
  Eigen::Index size = 0;
  for (const ForceBlock &block : blocks)
    size += Eigen::Index(block.n_measures) * block.n_measures;
  return size;
}

const std::vector<int> &LinearSolver::leading() const
{
  static const std::vector<int> none;
  return none;
}

void LinearSolver::solve_leading(const Eigen::VectorXd &, const Eigen::VectorXd &, Eigen::VectorXd &) const
{
  throw std::logic_error("LinearSolver: there are no leading coordinates");
}

void LinearSolver::solve_following(const Eigen::VectorXd &, const Eigen::VectorXd &, Eigen::VectorXd &) const
{
  throw std::logic_error("LinearSolver: there are no leading coordinates");
}

bool LinearSystem::dense_matrices(Eigen::MatrixXd &, Eigen::MatrixXd &, Eigen::MatrixXd &) const
{
  return false;
}

bool LinearSystem::sparse_matrices(Eigen::SparseMatrix<double> &, Eigen::SparseMatrix<double> &,
                                   Eigen::SparseMatrix<double> &) const
{
  return false;
}

std::vector<ForceBlock> LocalForces::blocks() const
{
  return {{0, static_cast<int>(directions().cols())}};
}

void LocalForces::tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                 Eigen::VectorXd &blocks) const
{
  Eigen::MatrixXd dp = Eigen::MatrixXd::Zero(p.size(), p.size());
  tangent(state, w_u, w_v, w_a, p, dp);
  for (const HeldMeasure &h : held())
  {
    dp.row(h.measure).setZero();
    dp.col(h.measure).setZero();
  }
  Eigen::Index first = 0;
  for (const ForceBlock &block : this->blocks())
  {
    const int k                                       = block.n_measures;
    Eigen::Map<Eigen::MatrixXd>(&blocks[first], k, k) = dp.block(block.first_measure, block.first_measure, k, k);
    first += Eigen::Index(k) * k;
  }
}

const std::vector<HeldMeasure> &LocalForces::held() const
{
  static const std::vector<HeldMeasure> none;
  return none;
}

const std::vector<int> &LinearSystem::virtual_coordinates() const
{
  static const std::vector<int> none;
  return none;
}

const std::vector<ConstraintBlock> &IdealJoints::blocks() const
{
  static const std::vector<ConstraintBlock> none;
  return none;
}

void IdealJoints::constraints(const LocalState &, Eigen::VectorXd &g, ConstraintJacobian &) const
{
  g.setZero();
}

void IdealJoints::rates(const LocalState &, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const
{
  rate.setZero();
  bias.setZero();
}

std::string IdealJoints::name(int i) const
{
  return "constraint " + std::to_string(i + 1);
}

const IdealJoints &SecondOrderSystem::joints() const
{
  static const IdealJoints none;
  return none;
}

namespace
{
EventSystem &no_events()
{
  static EventSystem none; // has no state
  return none;
}
} // namespace

const EventSystem &SecondOrderSystem::events() const
{
  return no_events();
}
EventSystem &SecondOrderSystem::events()
{
  return no_events();
}

const EnergyAccount &SecondOrderSystem::energy() const
{
  static const EnergyAccount none;
  return none;
}

} // namespace gestell::coupling
