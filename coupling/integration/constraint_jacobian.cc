#include "coupling/integration/constraint_jacobian.h"

#include <algorithm>

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
    const double          *G = values_.data() + first_[i];
    for (int k = 0; k < b.n_measures; ++k, G += b.n_rows)
    {
      double sum = 0.;
      for (int r = 0; r < b.n_rows; ++r)
        sum += G[r] * lambda[b.first_row + r];
      p[b.first_measure + k] = sum;
    }
  }
}

void ConstraintJacobian::add_product(double factor, const Eigen::VectorXd &u, Eigen::VectorXd &g) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    const double          *G = values_.data() + first_[i];
    for (int k = 0; k < b.n_measures; ++k, G += b.n_rows)
      for (int r = 0; r < b.n_rows; ++r)
        g[b.first_row + r] += factor * G[r] * u[b.first_measure + k];
  }
}

// A joint depends on some of its measures only: zeros are left out.

void ConstraintJacobian::times_transposed(const Eigen::MatrixXd &S, Eigen::MatrixXd &product) const
{
  const Eigen::Index n = S.rows();
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    const double          *G = values_.data() + first_[i];
    std::fill_n(product.data() + n * b.first_row, n * b.n_rows, 0.);
    for (int k = 0; k < b.n_measures; ++k)
      for (int r = 0; r < b.n_rows; ++r)
        if (const double factor = G[r + b.n_rows * k]; factor != 0.)
        {
          const double *from = S.data() + n * (b.first_measure + k);
          double       *to   = product.data() + n * (b.first_row + r);
          for (Eigen::Index j = 0; j < n; ++j)
            to[j] += factor * from[j];
        }
  }
}

void ConstraintJacobian::times(const Eigen::MatrixXd &X, Eigen::MatrixXd &product) const
{
  product.setZero();
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    const double          *G = values_.data() + first_[i];
    for (int k = 0; k < b.n_measures; ++k)
      for (int r = 0; r < b.n_rows; ++r)
        if (const double factor = G[r + b.n_rows * k]; factor != 0.)
          for (Eigen::Index j = 0; j < X.cols(); ++j)
            product(b.first_row + r, j) += factor * X(b.first_measure + k, j);
  }
}

} // namespace gestell::coupling
