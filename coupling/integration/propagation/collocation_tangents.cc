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

/// Rows and columns of some measures, at each of s points, of a matrix of all.
MatrixXd of_measures(const MatrixXd &all, const std::vector<int> &measures, int s, int n_u)
{
  const Index n = Index(measures.size());
  MatrixXd    some(s * n, s * n);
  for (int j = 0; j < s; ++j)
    for (Index b = 0; b < n; ++b)
      for (int i = 0; i < s; ++i)
        for (Index a = 0; a < n; ++a)
          some(i * n + a, j * n + b) = all(i * n_u + measures[a], j * n_u + measures[b]);
  return some;
}
} // namespace

/// Derivatives of the forces at the points of the step solved last, and the measures in which they are not zero or that
/// are held: open contacts and idle elements are none of them.
CollocationStep::LinearisedForces CollocationStep::linearised_forces()
{
  const LocalForces &forces = context_.system->forces();
  LinearisedForces   at{MatrixXd(n_u_, s_ * n_u_), MatrixXd(n_u_, s_ * n_u_), {}};
  for (int i = 0; i < s_; ++i)
  {
    node_.t = begin_at_.t + basis_.points[i] * h_;
    node_.u = U_.col(i + 1);
    node_.v = V_.col(i + 1);
    node_.p = P_.segment(i * n_u_, n_u_);
    forces.derivatives(node_, node_.p, dp_du_, dp_dv_);
    at.of_u.middleCols(i * n_u_, n_u_) = dp_du_;
    at.of_v.middleCols(i * n_u_, n_u_) = dp_dv_;
  }
  context_.work.evaluations += s_;
  for (int m = 0; m < n_u_; ++m)
  {
    bool active = is_held(m);
    for (int i = 0; i < s_ && !active; ++i)
      for (const MatrixXd *of : {&at.of_u, &at.of_v})
      {
        const auto point = of->middleCols(i * n_u_, n_u_);
        active           = active || !point.row(m).isZero(0.) || !point.col(m).isZero(0.);
      }
    if (active)
      at.measures.push_back(m);
  }
  return at;
}

/// What solve() solves, linearised at its solution, for the measures in which forces change:
///     dp_i = dp/du du_i + dp/dv dv_i,   du_i = row_u,i^T dx + sum_j S_u(i, j) dp_j,   dv_i likewise;   dv_i = 0 if
///     held.
void CollocationStep::carry_tangents(MatrixXd &X)
{
  const StepTable       &table = *tried_;
  const LinearisedForces at    = linearised_forces();
  const Index            n     = Index(at.measures.size());
  if (n == 0)
  {
    carry_blocks(table, X);
    return;
  }
  MatrixXd rows(2 * s_ * n, X.rows()), in(X.rows(), s_ * n);
  for (int i = 0; i < s_; ++i)
    for (Index a = 0; a < n; ++a)
    {
      rows.row(2 * i * n + a)       = table.rows.col(2 * i * n_u_ + at.measures[a]);
      rows.row((2 * i + 1) * n + a) = table.rows.col((2 * i + 1) * n_u_ + at.measures[a]);
      in.col(i * n + a)             = table.in.col(i * n_u_ + at.measures[a]);
    }
  const MatrixXd free = rows * X, S_u = of_measures(table.S_u, at.measures, s_, n_u_),
                 S_v = of_measures(table.S_v, at.measures, s_, n_u_);
  MatrixXd matrix(s_ * n, s_ * n), dP(s_ * n, X.cols()), of_u(n, n), of_v(n, n);
  for (int i = 0; i < s_; ++i)
  {
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b)
      {
        of_u(a, b) = at.of_u(at.measures[a], i * n_u_ + at.measures[b]);
        of_v(a, b) = at.of_v(at.measures[a], i * n_u_ + at.measures[b]);
      }
    const auto u = free.middleRows(2 * i * n, n), v = free.middleRows((2 * i + 1) * n, n);
    matrix.middleRows(i * n, n) = -of_u * S_u.middleRows(i * n, n) - of_v * S_v.middleRows(i * n, n);
    dP.middleRows(i * n, n)     = of_u * u + of_v * v;
    for (Index a = 0; a < n; ++a)
    {
      matrix(i * n + a, i * n + a) += 1.;
      if (!is_held(at.measures[a]))
        continue;
      matrix.row(i * n + a) = S_v.row(i * n + a) / table.h;
      dP.row(i * n + a)     = -v.row(a) / table.h;
    }
  }
  dP = matrix.partialPivLu().solve(dP).eval();
  carry_blocks(table, X);
  X.noalias() += in * dP;
  context_.project_held_tangents(begin_at_.t + table.h, X);
}

} // namespace gestell::coupling
