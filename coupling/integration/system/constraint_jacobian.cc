#include "coupling/integration/system/constraint_jacobian.h"

#include <algorithm>
#include <type_traits>

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

namespace
{
/// Calls work with the number of rows as a constant if it is small, because loops cost more than their contents.
template <class Work>
void with_rows(int n_rows, const Work &work)
{
  switch (n_rows)
  {
  case 1:
    return work(std::integral_constant<int, 1>{});
  case 2:
    return work(std::integral_constant<int, 2>{});
  case 3:
    return work(std::integral_constant<int, 3>{});
  case 5:
    return work(std::integral_constant<int, 5>{});
  case 6:
    return work(std::integral_constant<int, 6>{});
  default:
    return work(n_rows);
  }
}
} // namespace

void ConstraintJacobian::set_forces(const Eigen::VectorXd &lambda, Eigen::VectorXd &p) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    with_rows(b.n_rows,
              [&](const auto n_rows)
              {
                const double *G = values_.data() + first_[i], *force = lambda.data() + b.first_row;
                double       *to = p.data() + b.first_measure;
                for (int k = 0; k < b.n_measures; ++k, G += n_rows)
                {
                  double sum = 0.;
                  for (int r = 0; r < n_rows; ++r)
                    sum += G[r] * force[r];
                  to[k] = sum;
                }
              });
  }
}

void ConstraintJacobian::add_product(double factor, const Eigen::VectorXd &u, Eigen::VectorXd &g) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    with_rows(b.n_rows,
              [&](const auto n_rows)
              {
                const double *G = values_.data() + first_[i], *from = u.data() + b.first_measure;
                double       *to = g.data() + b.first_row;
                for (int k = 0; k < b.n_measures; ++k, G += n_rows)
                {
                  const double move = factor * from[k];
                  for (int r = 0; r < n_rows; ++r)
                    to[r] += G[r] * move;
                }
              });
  }
}

namespace
{
/// The columns S G_i^T [n x rows] of one joint for `rows` of its equations, n >= 4: every number of S is read once.
/// @param S,  G  of the first measure of the joint; `stride` from column to column of G
template <int rows>
void columns_of_joint(const double *S, Eigen::Index n, int n_measures, const double *G, int stride, double *to)
{
  using Packet = Eigen::Array<double, 4, 1>;
  for (Eigen::Index next = 0; next < n; next += 4)
  {
    const Eigen::Index j = std::min(next, n - 4); // the last four overlap those before
    Packet             sum[rows];
    for (int k = 0; k < n_measures; ++k)
    {
      const Packet s = Eigen::Map<const Packet>(S + n * k + j);
      for (int r = 0; r < rows; ++r)
        sum[r] = k == 0 ? Packet(G[r] * s) : Packet(sum[r] + G[r + stride * k] * s);
    }
    for (int r = 0; r < rows; ++r)
      Eigen::Map<Packet>(to + n * r + j) = sum[r];
  }
}
} // namespace

void ConstraintJacobian::times_transposed(const Eigen::MatrixXd &S, Eigen::MatrixXd &product) const
{
  const Eigen::Index n = S.rows();
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b    = blocks_[i];
    const double          *G    = values_.data() + first_[i];
    const double          *from = S.data() + n * b.first_measure;
    double                *to   = product.data() + n * b.first_row;
    if (n < 4)
    {
      for (int r = 0; r < b.n_rows; ++r, to += n)
        for (Eigen::Index j = 0; j < n; ++j)
        {
          to[j] = 0.;
          for (int k = 0; k < b.n_measures; ++k)
            to[j] += G[r + b.n_rows * k] * from[n * k + j];
        }
      continue;
    }
    with_rows(b.n_rows,
              [&](const auto n_rows)
              {
                if constexpr (std::is_integral_v<std::remove_const_t<decltype(n_rows)>>)
                  for (int r = 0; r < n_rows; ++r)
                    columns_of_joint<1>(from, n, b.n_measures, G + r, n_rows, to + n * r);
                else
                  columns_of_joint<n_rows>(from, n, b.n_measures, G, n_rows, to);
              });
  }
}

void ConstraintJacobian::times(const Eigen::MatrixXd &X, Eigen::MatrixXd &product) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    const ConstraintBlock &b = blocks_[i];
    with_rows(b.n_rows,
              [&](const auto n_rows)
              {
                for (Eigen::Index j = 0; j < X.cols(); ++j)
                {
                  const double *G  = values_.data() + first_[i];
                  const double *x  = X.data() + X.rows() * j + b.first_measure;
                  double       *to = product.data() + product.rows() * j + b.first_row;
                  for (int r = 0; r < n_rows; ++r)
                    to[r] = 0.;
                  for (int k = 0; k < b.n_measures; ++k, G += n_rows)
                    for (int r = 0; r < n_rows; ++r)
                      to[r] += G[r] * x[k];
                }
              });
  }
}

} // namespace gestell::coupling
