#include "coupling/integration/propagation/collocation_step.h"

#include "coupling/integration/system/turning_forces.h"

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;

/// E X by blocks.
/// @param first  work space
void carry_blocks(const StepTable &table, Eigen::ArrayXd &first, MatrixXd &X)
{
  const Index n_p = table.E.rows();
  const auto  e   = table.E.array();
  for (Index k = 0; k < X.cols(); ++k)
  {
    auto x_1 = X.col(k).head(n_p).array(), x_2 = X.col(k).tail(n_p).array();
    first = e.col(0) * x_1 + e.col(1) * x_2;
    x_2   = e.col(2) * x_1 + e.col(3) * x_2;
    x_1   = first;
  }
}

/// Rows and columns of some measures, at each of s points, of a matrix of all.
template <typename Matrix>
void take(const Matrix &all, const std::vector<int> &measures, int s, int n_u, MatrixXd &some)
{
  const Index n = Index(measures.size());
  some.resize(s * n, s * n);
  for (int j = 0; j < s; ++j)
    for (Index b = 0; b < n; ++b)
      for (int i = 0; i < s; ++i)
        for (Index a = 0; a < n; ++a)
          some(i * n + a, j * n + b) = all(i * n_u + measures[a], j * n_u + measures[b]);
}
} // namespace

/// Derivatives of the forces at the points of the last step, and the measures with nonzero derivatives or sticking
/// ones: open contacts and idle elements are excluded.
void CollocationStep::linearise_forces()
{
  TangentWork &at = tangent_;
  at.all_of_u.resize(n_u_, s_ * n_u_);
  at.all_of_v.resize(n_u_, s_ * n_u_);
  at.measures.clear();
  for (int i = 0; i < s_; ++i)
  {
    node_.t = begin_at_.t + basis_.points[i] * h_;
    node_.u = U_.col(i + 1);
    node_.v = V_.col(i + 1);
    node_.p = P_.segment(i * n_u_, n_u_);
    linearise(context_.system->forces(), node_, node_.p, dp_du_, dp_dv_);
    at.all_of_u.middleCols(i * n_u_, n_u_) = dp_du_;
    at.all_of_v.middleCols(i * n_u_, n_u_) = dp_dv_;
  }
  context_.work.evaluations += s_;
  for (int m = 0; m < n_u_; ++m)
  {
    bool active = is_held(m);
    for (int i = 0; i < s_ && !active; ++i)
      for (const MatrixXd *of : {&at.all_of_u, &at.all_of_v})
      {
        const auto point = of->middleCols(i * n_u_, n_u_);
        active           = active || !point.row(m).isZero(0.) || !point.col(m).isZero(0.);
      }
    if (active)
      at.measures.push_back(m);
  }
}

/// Rows, columns and mobilities of these measures from the table of the step.
void CollocationStep::take_measures(const StepTable &table)
{
  TangentWork &at = tangent_;
  const Index  n = Index(at.measures.size()), n_x = table.rows.rows();
  at.rows.resize(2 * s_ * n, n_x);
  at.in.resize(n_x, s_ * n);
  for (int i = 0; i < s_; ++i)
    for (Index a = 0; a < n; ++a)
    {
      at.rows.row(2 * i * n + a)       = table.rows.col(2 * i * n_u_ + at.measures[a]);
      at.rows.row((2 * i + 1) * n + a) = table.rows.col((2 * i + 1) * n_u_ + at.measures[a]);
      at.in.col(i * n + a)             = table.in.col(i * n_u_ + at.measures[a]);
    }
  take(table.S_u, at.measures, s_, n_u_, at.S_u);
  take(table.S_v, at.measures, s_, n_u_, at.S_v);
}

/// Equations of point i for dP.
void CollocationStep::fill_tangent_rows(const StepTable &table, int i)
{
  TangentWork &at = tangent_;
  const Index  n  = Index(at.measures.size());
  at.of_u.resize(n, n);
  at.of_v.resize(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b)
    {
      at.of_u(a, b) = at.all_of_u(at.measures[a], i * n_u_ + at.measures[b]);
      at.of_v(a, b) = at.all_of_v(at.measures[a], i * n_u_ + at.measures[b]);
    }
  const auto u = at.free.middleRows(2 * i * n, n), v = at.free.middleRows((2 * i + 1) * n, n);
  auto       matrix = at.matrix.middleRows(i * n, n), forces = at.forces.middleRows(i * n, n);
  matrix.noalias() = -at.of_u * at.S_u.middleRows(i * n, n);
  matrix.noalias() -= at.of_v * at.S_v.middleRows(i * n, n);
  forces.noalias() = at.of_u * u;
  forces.noalias() += at.of_v * v;
  for (Index a = 0; a < n; ++a)
  {
    matrix(a, i * n + a) += 1.;
    if (!is_held(at.measures[a]))
      continue;
    matrix.row(a) = at.S_v.row(i * n + a) / table.h;
    forces.row(a) = -v.row(a) / table.h;
  }
}

/// Linearises the equations of solve() at their solution, for the measures in which forces change: dp_i = dp/du du_i +
/// dp/dv dv_i,   du_i = row_u,i^T dx + sum_j S_u(i, j) dp_j,   dv_i in the same way;   dv_i = 0 if sticking.
void CollocationStep::carry_tangents(MatrixXd &X)
{
  const StepTable &table = *tried_;
  TangentWork     &at    = tangent_;
  linearise_forces();
  const Index n = Index(at.measures.size());
  if (n == 0)
  {
    carry_blocks(table, at.first, X);
    return;
  }
  take_measures(table);
  at.free.resize(at.rows.rows(), X.cols());
  at.free.noalias() = at.rows * X;
  at.matrix.resize(s_ * n, s_ * n);
  at.forces.resize(s_ * n, X.cols());
  for (int i = 0; i < s_; ++i)
    fill_tangent_rows(table, i);
  at.lu.compute(at.matrix);
  at.dP = at.lu.solve(at.forces);
  carry_blocks(table, at.first, X);
  X.noalias() += at.in * at.dP;
  context_.project_held_tangents(begin_at_.t + table.h, X);
}

} // namespace gestell::coupling
