#include "coupling/integration/constraint_jacobian.h"

namespace gestell::coupling
{

ConstraintJacobian::ConstraintJacobian(const std::vector<ConstraintBlock> &blocks) : blocks_(blocks)
{
  Eigen::Index size = 0;
  for (const ConstraintBlock &block : blocks_)
  {
    first_.push_back(size);
    size += Eigen::Index(block.n_rows) * block.n_measures;
  }
  values_.setZero(size);
}

void ConstraintJacobian::set_forces(const Eigen::VectorXd &lambda, Eigen::VectorXd &p) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    p.segment(b.first_measure, b.n_measures) =
        (*this)[i].transpose().lazyProduct(lambda.segment(b.first_row, b.n_rows));
  }
}

void ConstraintJacobian::add_product(double factor, const Eigen::VectorXd &u, Eigen::VectorXd &g) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    g.segment(b.first_row, b.n_rows) += factor * (*this)[i].lazyProduct(u.segment(b.first_measure, b.n_measures));
  }
}

void ConstraintJacobian::times_transposed(const Eigen::MatrixXd &S, Eigen::MatrixXd &product) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    product.middleCols(b.first_row, b.n_rows) =
        S.middleCols(b.first_measure, b.n_measures).lazyProduct((*this)[i].transpose());
  }
}

void ConstraintJacobian::times(const Eigen::MatrixXd &X, Eigen::MatrixXd &product) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b                  = blocks_[i];
    product.middleRows(b.first_row, b.n_rows) = (*this)[i].lazyProduct(X.middleRows(b.first_measure, b.n_measures));
  }
}

} // namespace gestell::coupling
