#include "coupling/sensitivity/variational_equation.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

} // namespace

VariationalEquation::VariationalEquation(Machine &machine, const std::vector<ParameterTwins> &twins)
    : machine_(machine), linearisation_(machine, twins), n_parameters_(int(twins.size())),
      lags_(machine.linear().virtual_coordinates())
{
  const Index     n               = machine.size();
  constexpr Index largest_inverse = 200; // coordinates of systems whose A^-1 is kept: it fits a cache
  if (n > largest_inverse || !machine.linear().dense_matrices(M_, B_, C_))
    for (MatrixXd *matrix : {&M_, &B_, &C_})
      matrix->resize(0, 0);
  mass_.resize(n);
  product_.resize(n);
  VectorXd unit = VectorXd::Zero(n), column(n);
  for (Index i = 0; i < n; ++i)
  {
    unit[i] = 1.;
    machine.linear().mass_times(unit, column);
    mass_[i] = column[i];
    if (std::count(lags_.begin(), lags_.end(), int(i)) > 0)
    {
      machine.linear().damping_times(unit, column);
      time_constants_.push_back(column[i]);
    }
    unit[i] = 0.;
  }
}

/// Coordinates without mass obey T s' + s = r + dp: the residual is in the place of accelerations and corrects s'.
void VariationalEquation::settle_lags(const Linearised &at, MotionColumns &columns) const
{
  for (std::size_t i = 0; i < lags_.size(); ++i)
  {
    columns.v.row(lags_[i]) += columns.a.row(lags_[i]) / time_constants_[i];
    columns.a.row(lags_[i]).setZero();
  }
  if (lags_.empty())
    return;
  columns.u_rate.noalias() = machine_.forces().directions().transpose() * columns.v;
  if (at.v.size() > 0)
    columns.u_rate += at.v;
}

const VariationalEquation::Base &VariationalEquation::base(double c)
{
  const auto found = bases_.find(c);
  if (found != bases_.end())
    return found->second;
  constexpr std::size_t most_bases = 64; // factors kept: each is as large as a matrix
  if (bases_.size() >= most_bases)
    bases_.clear();
  Base        made;
  const Index n = machine_.size();
  made.solver   = machine_.linear().factorise(1., c, c * c);
  if (B_.size() > 0)
  {
    made.inverse.resize(n, n);
    VectorXd unit = VectorXd::Zero(n), column(n);
    for (Index i = 0; i < n; ++i)
    {
      unit[i] = 1.;
      made.solver->solve(unit, column);
      made.inverse.col(i) = column;
      unit[i]             = 0.;
    }
    made.B.noalias() = made.inverse * B_;
    made.C.noalias() = made.inverse * C_;
  }
  const auto &W = machine_.forces().directions();
  solve_base(made, MatrixXd(W), made.Y);
  made.S = W.transpose() * made.Y;
  return bases_.emplace(c, std::move(made)).first->second;
}

void VariationalEquation::solve_base(const Base &base, const MatrixXd &F, MatrixXd &X) const
{
  if (base.inverse.size() > 0)
  {
    X.noalias() = base.inverse * F;
    return;
  }
  X.resize(F.rows(), F.cols());
  VectorXd f(F.rows()), x(F.rows());
  for (Index k = 0; k < F.cols(); ++k)
  {
    f = F.col(k);
    base.solver->solve(f, x);
    X.col(k) = x;
  }
}

/// f = r - B s'_0 - C (s_0 + c s'_0), columns.q = s_0 + c s'_0
void VariationalEquation::find_loads(const Linearised &at, const MotionColumns &columns)
{
  F_ = at.r;
  if (B_.size() > 0)
  {
    F_.noalias() -= B_ * columns.v;
    F_.noalias() -= C_ * columns.q;
  }
  else
    for (Index k = 0; k < n_parameters_; ++k)
    {
      machine_.linear().damping_times(columns.v.col(k), product_);
      F_.col(k) -= product_;
      machine_.linear().stiffness_times(columns.q.col(k), product_);
      F_.col(k) -= product_;
    }
}

/// columns.a = A^-1 f; for small systems by A^-1 B and A^-1 C, since few parameters change loads r.
void VariationalEquation::answer_loads(const Base &base, const Linearised &at, MotionColumns &columns)
{
  if (base.inverse.size() == 0)
  {
    find_loads(at, columns);
    solve_base(base, F_, columns.a);
    return;
  }
  columns.a.noalias() = -base.B * columns.v;
  columns.a.noalias() -= base.C * columns.q;
  for (Index k = 0; k < n_parameters_; ++k)
    if (!at.r.col(k).isZero(0.))
      columns.a.col(k).noalias() += base.inverse * at.r.col(k);
}

/// u'' = x + S dp of the measures, dp = k + K u'' + G^T dlambda + dp_h: as many unknowns as there are measures.
void VariationalEquation::solve_condensed(const Base &base, const Linearised &at, double c, MotionColumns &columns)
{
  const auto &W    = machine_.forces().directions();
  const auto &held = machine_.forces().held();
  const Index n_u = W.cols(), n_c = machine_.joints().n_rows(), n_h = Index(held.size()), size = n_u + n_c + n_h;
  answer_loads(base, at, columns);
  X_.noalias() = W.transpose() * columns.a;
  if (at.a.size() > 0)
    X_ += at.a;
  matrix_.setZero(size, size);
  right_.setZero(size, n_parameters_);
  matrix_.topLeftCorner(n_u, n_u).setIdentity();
  matrix_.topLeftCorner(n_u, n_u).noalias() -= base.S * K_;
  right_.topRows(n_u) = X_;
  right_.topRows(n_u).noalias() += base.S * k_;
  if (n_c > 0)
  {
    S_G_.resize(n_u, n_c);
    at.G.times_transposed(base.S, S_G_);
    matrix_.block(0, n_u, n_u, n_c) = -S_G_;
    matrix_.block(n_u, 0, n_c, n_u) = joint_rows(at, c);
    right_.middleRows(n_u, n_c)     = joint_right(at, columns);
  }
  for (Index h = 0; h < n_h; ++h)
  {
    const int measure                    = held[std::size_t(h)].measure;
    matrix_.col(n_u + n_c + h).head(n_u) = -base.S.col(measure);
    matrix_(n_u + n_c + h, measure)      = 1.;
  }
  if (size > 0)
    right_ = lu_solution(matrix_, right_);
  columns.u_acc = right_.topRows(n_u);
  find_forces(at, columns);
  columns.a.noalias() += base.Y * columns.p;
}

/// (A - W K W^T) s'' - W (G^T dlambda + dp_h) = f + W k: fewer unknowns where many measures act on few coordinates.
void VariationalEquation::solve_whole(const Linearised &at, double c, MotionColumns &columns)
{
  const auto &W    = machine_.forces().directions();
  const auto &held = machine_.forces().held();
  const Index n = W.rows(), n_c = machine_.joints().n_rows(), n_h = Index(held.size()), size = n + n_c + n_h;
  find_loads(at, columns);
  if (at.a.size() > 0)
    k_ += K_ * at.a;
  matrix_.setZero(size, size);
  right_.setZero(size, n_parameters_);
  matrix_.topLeftCorner(n, n) = M_ + c * B_ + c * c * C_;
  if (c == 0.)
    for (const int i : lags_)
      matrix_(i, i) = 1.;
  matrix_.topLeftCorner(n, n) -= W * MatrixXd(K_ * W.transpose());
  right_.topRows(n) = F_ + W * k_;
  if (n_c > 0)
  {
    const MatrixXd rows         = joint_rows(at, c);
    matrix_.block(n, 0, n_c, n) = rows * W.transpose();
    right_.middleRows(n, n_c)   = joint_right(at, columns);
    if (at.a.size() > 0)
      right_.middleRows(n, n_c) -= rows * at.a;
    for (std::size_t b = 0; b < at.G.blocks().size(); ++b)
    {
      const ConstraintBlock &block = at.G.blocks()[b];
      matrix_.block(0, n + block.first_row, n, block.n_rows) =
          -(W.middleCols(block.first_measure, block.n_measures) * at.G[b].transpose());
    }
  }
  for (Index h = 0; h < n_h; ++h)
  {
    const Eigen::SparseVector<double> w = W.col(held[std::size_t(h)].measure);
    for (Eigen::SparseVector<double>::InnerIterator it(w); it; ++it)
    {
      matrix_(it.index(), n + n_c + h) = -it.value();
      matrix_(n + n_c + h, it.index()) = it.value();
    }
    if (at.a.size() > 0)
      right_.row(n + n_c + h) = -at.a.row(held[std::size_t(h)].measure);
  }
  right_                  = lu_solution(matrix_, right_);
  columns.a               = right_.topRows(n);
  columns.u_acc.noalias() = W.transpose() * columns.a;
  if (at.a.size() > 0)
  {
    k_ -= K_ * at.a;
    columns.u_acc += at.a;
  }
  find_forces(at, columns);
}

/// G + c Gamma_v + c^2 Gamma_u [n_c x n_u]
MatrixXd VariationalEquation::joint_rows(const Linearised &at, double c) const
{
  MatrixXd rows = c * c * at.Gamma_u + c * at.Gamma_v;
  for (std::size_t b = 0; b < at.G.blocks().size(); ++b)
  {
    const ConstraintBlock &block = at.G.blocks()[b];
    rows.block(block.first_row, block.first_measure, block.n_rows, block.n_measures) += at.G[b];
  }
  return rows;
}

MatrixXd VariationalEquation::joint_right(const Linearised &at, const MotionColumns &columns) const
{
  return -at.gamma - at.Gamma_u * columns.u - at.Gamma_v * columns.u_rate;
}

/// dp and dlambda from the last solution in right_: dlambda and dp_h.
void VariationalEquation::find_forces(const Linearised &at, MotionColumns &columns) const
{
  const auto &held = machine_.forces().held();
  const Index n_c = machine_.joints().n_rows(), n_h = Index(held.size());
  columns.p = k_;
  columns.p.noalias() += K_ * columns.u_acc;
  columns.lambda = right_.bottomRows(n_c + n_h).topRows(n_c);
  for (std::size_t b = 0; b < at.G.blocks().size() && n_c > 0; ++b)
  {
    const ConstraintBlock &block = at.G.blocks()[b];
    columns.p.middleRows(block.first_measure, block.n_measures).noalias() +=
        at.G[b].transpose() * columns.lambda.middleRows(block.first_row, block.n_rows);
  }
  for (Index h = 0; h < n_h; ++h)
    columns.p.row(held[std::size_t(h)].measure) = right_.bottomRows(n_h).row(h);
}

/// s and its measures by the impulses on joints, and on what sticks there, that change G W^T s by -open.
void VariationalEquation::move(const Linearised &at, const MatrixXd &open, MatrixXd &s, MatrixXd &of_measures)
{
  const Base &mass = base(0.);
  const auto &held = machine_.forces().held();
  const Index n_c = open.rows(), n_h = Index(held.size());
  MatrixXd    S_J(of_measures.rows(), n_c + n_h), Y_J(s.rows(), n_c + n_h), J_S_J(n_c + n_h, n_c + n_h),
      product(n_c, n_c + n_h);
  at.G.times_transposed(mass.S, S_J); // of the first columns
  at.G.times_transposed(mass.Y, Y_J);
  for (Index h = 0; h < n_h; ++h)
  {
    S_J.col(n_c + h) = mass.S.col(held[std::size_t(h)].measure);
    Y_J.col(n_c + h) = mass.Y.col(held[std::size_t(h)].measure);
  }
  at.G.times(S_J, product);
  J_S_J.topRows(n_c) = product;
  for (Index h = 0; h < n_h; ++h)
    J_S_J.row(n_c + h) = S_J.row(held[std::size_t(h)].measure);
  MatrixXd right         = MatrixXd::Zero(n_c + n_h, open.cols());
  right.topRows(n_c)     = -open;
  const MatrixXd impulse = lu_solution(J_S_J, right);
  s.noalias() += Y_J * impulse;
  of_measures.noalias() += S_J * impulse;
}

void VariationalEquation::close_joints(const Linearised &at, MotionColumns &columns)
{
  if (machine_.joints().n_rows() == 0)
    return;
  MatrixXd open(at.g.rows(), at.g.cols());
  at.G.times(columns.u, open);
  open += at.g;
  move(at, open, columns.q, columns.u);
  at.G.times(columns.u_rate, open);
  open += at.g_rate;
  open.noalias() += at.G_rate * columns.u;
  move(at, open, columns.v, columns.u_rate);
  solve(at, 0., columns);
}

void VariationalEquation::solve(const Linearised &at, double c, MotionColumns &columns)
{
  const auto &W = machine_.forces().directions();
  columns.q += c * columns.v;
  columns.u.noalias()      = W.transpose() * columns.q;
  columns.u_rate.noalias() = W.transpose() * columns.v;
  if (at.u.size() > 0)
  {
    columns.u += at.u;
    columns.u_rate += at.v;
  }
  K_ = c * c * at.P_u + c * at.P_v + at.P_a;
  k_ = at.p;
  k_.noalias() += at.P_u * columns.u;
  k_.noalias() += at.P_v * columns.u_rate;
  for (const HeldMeasure &h : machine_.forces().held())
    k_.row(h.measure).setZero();
  if (M_.size() > 0 && W.rows() < W.cols())
    solve_whole(at, c, columns);
  else
    solve_condensed(base(c), at, c, columns);
  if (c == 0.)
    settle_lags(at, columns);
  columns.q += c * c * columns.a;
  columns.v += c * columns.a;
  columns.u += c * c * columns.u_acc;
  columns.u_rate += c * columns.u_acc;
}

} // namespace gestell::coupling
