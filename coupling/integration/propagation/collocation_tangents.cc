#include "coupling/integration/propagation/collocation_step.h"

#include <Eigen/LU>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;

/// E X by blocks.
void carry_blocks(const StepTable &table, MatrixXd &X)
{
  const Index    n_p = table.E.rows();
  const auto     e   = table.E.array();
  Eigen::ArrayXd first(n_p);
  for (Index k = 0; k < X.cols(); ++k)
  {
    auto x_1 = X.col(k).head(n_p).array(), x_2 = X.col(k).tail(n_p).array();
    first = e.col(0) * x_1 + e.col(1) * x_2;
    x_2   = e.col(2) * x_1 + e.col(3) * x_2;
    x_1   = first;
  }
}
} // namespace

/// What solve() solves, linearised at its solution:
///     dp_i = dp/du du_i + dp/dv dv_i,   du_i = row_u,i^T dx + sum_j S_u(i, j) dp_j,   dv_i likewise;   dv_i = 0 if
///     held.
void CollocationStep::carry_tangents(MatrixXd &X)
{
  const StepTable   &table  = *tried_;
  const LocalForces &forces = context_.system->forces();
  const MatrixXd     free   = table.rows.transpose() * X;
  MatrixXd           matrix(s_ * n_u_, s_ * n_u_), dP(s_ * n_u_, X.cols());
  for (int i = 0; i < s_; ++i)
  {
    node_.t = begin_at_.t + basis_.points[i] * table.h;
    node_.u = U_.col(i + 1);
    node_.v = V_.col(i + 1);
    node_.p = P_.segment(i * n_u_, n_u_);
    forces.derivatives(node_, node_.p, dp_du_, dp_dv_);
    fill_rows(table, i, matrix);
    auto dp      = dP.middleRows(i * n_u_, n_u_);
    dp.noalias() = dp_du_ * free.middleRows(2 * i * n_u_, n_u_);
    dp.noalias() += dp_dv_ * free.middleRows((2 * i + 1) * n_u_, n_u_);
  }
  context_.work.evaluations += s_;
  matrix.diagonal().array() += 1.;
  for (const HeldMeasure &held : forces.held())
    for (int i = 0; i < s_; ++i)
    {
      const int row   = i * n_u_ + held.measure;
      matrix.row(row) = table.S_v.row(row) / table.h;
      dP.row(row)     = -free.row((2 * i + 1) * n_u_ + held.measure) / table.h;
    }
  dP = matrix.partialPivLu().solve(dP).eval();
  carry_blocks(table, X);
  X.noalias() += table.in * dP;
  context_.project_held_tangents(begin_at_.t + table.h, X);
}

} // namespace gestell::coupling
