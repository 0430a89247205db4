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

constexpr Index       largest_inverse = 200; ///< coordinates of systems whose A^-1 is kept
constexpr std::size_t most_bases      = 64;  ///< factors kept
} // namespace

VariationalEquation::VariationalEquation(Machine &machine, const std::vector<ParameterTwins> &twins)
    : machine_(machine), linearisation_(machine, twins), n_parameters_(int(twins.size())),
      lags_(machine.linear().virtual_coordinates())
{
  const Index n = machine.size();
  MatrixXd    M;
  if (n > largest_inverse || !machine.linear().dense_matrices(M, B_, C_))
    B_.resize(0, 0);
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

/// Without mass, T s' + s = r + dp: what the equation lacks stands where accelerations do, and changes s'.
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

/// A a = r - B s'_0 - C (s_0 + c s'_0)
void VariationalEquation::solve_without_forces(const Base &base, const Linearised &at, double c, MotionColumns &columns)
{
  columns.q += c * columns.v;
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
  solve_base(base, F_, columns.a);
}

/// Rows and columns of the joints behind those of the measures.
void VariationalEquation::border_joints(const Base &base, const Linearised &at, double c, const MotionColumns &columns)
{
  const Index n_u = base.S.rows(), n_c = at.G.n_rows();
  S_G_.resize(n_u, n_c);
  at.G.times_transposed(base.S, S_G_);
  matrix_.block(0, n_u, n_u, n_c) = -S_G_;
  matrix_.block(n_u, 0, n_c, n_u) = c * c * at.Gamma_u + c * at.Gamma_v;
  for (std::size_t b = 0; b < at.G.blocks().size(); ++b)
  {
    const ConstraintBlock &block = at.G.blocks()[b];
    matrix_.block(n_u + block.first_row, block.first_measure, block.n_rows, block.n_measures) += at.G[b];
  }
  right_.middleRows(n_u, n_c) = -at.gamma;
  right_.middleRows(n_u, n_c).noalias() -= at.Gamma_u * columns.u;
  right_.middleRows(n_u, n_c).noalias() -= at.Gamma_v * columns.u_rate;
}

void VariationalEquation::solve(const Linearised &at, double c, MotionColumns &columns)
{
  const Base &base = this->base(c);
  const auto &W    = machine_.forces().directions();
  const Index n_u = W.cols(), n_c = machine_.joints().n_rows(), K = n_parameters_;
  const auto &held = machine_.forces().held();
  const Index n_h = Index(held.size()), size = n_u + n_c + n_h;

  solve_without_forces(base, at, c, columns);

  // The measures: u'' = x + S dp, dp = k + K u'' + G^T dlambda + dp_h
  columns.u.noalias()      = W.transpose() * columns.q;
  columns.u_rate.noalias() = W.transpose() * columns.v;
  X_.noalias()             = W.transpose() * columns.a;
  if (at.u.size() > 0)
  {
    columns.u += at.u;
    columns.u_rate += at.v;
    X_ += at.a;
  }
  K_ = c * c * at.P_u + c * at.P_v + at.P_a;
  k_ = at.p;
  k_.noalias() += at.P_u * columns.u;
  k_.noalias() += at.P_v * columns.u_rate;
  for (const HeldMeasure &h : held)
    k_.row(h.measure).setZero();
  matrix_.setZero(size, size);
  right_.setZero(size, K);
  matrix_.topLeftCorner(n_u, n_u).setIdentity();
  matrix_.topLeftCorner(n_u, n_u).noalias() -= base.S * K_;
  right_.topRows(n_u) = X_;
  right_.topRows(n_u).noalias() += base.S * k_;
  if (n_c > 0)
    border_joints(base, at, c, columns);
  for (Index h = 0; h < n_h; ++h)
  {
    const int measure                    = held[std::size_t(h)].measure;
    matrix_.col(n_u + n_c + h).head(n_u) = -base.S.col(measure);
    matrix_(n_u + n_c + h, measure)      = 1.;
  }
  if (size > 0)
    right_ = lu_solution(matrix_, right_);

  columns.u_acc = right_.topRows(n_u);
  columns.p     = k_;
  columns.p.noalias() += K_ * columns.u_acc;
  columns.lambda = right_.middleRows(n_u, n_c);
  for (std::size_t b = 0; b < at.G.blocks().size() && n_c > 0; ++b)
  {
    const ConstraintBlock &block = at.G.blocks()[b];
    columns.p.middleRows(block.first_measure, block.n_measures).noalias() +=
        at.G[b].transpose() * columns.lambda.middleRows(block.first_row, block.n_rows);
  }
  for (Index h = 0; h < n_h; ++h)
    columns.p.row(held[std::size_t(h)].measure) = right_.row(n_u + n_c + h);
  columns.a.noalias() += base.Y * columns.p;
  if (c == 0.)
    settle_lags(at, columns);
  columns.q += c * c * columns.a;
  columns.v += c * columns.a;
  columns.u += c * c * columns.u_acc;
  columns.u_rate += c * columns.u_acc;
}

} // namespace gestell::coupling
