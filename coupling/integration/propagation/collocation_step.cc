#include "coupling/integration/propagation/collocation_step.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

} // namespace

CollocationStep::CollocationStep(PropagationContext &context, int stages)
    : context_(context), s_(stages), n_u_(int(context.measures.put.cols())), basis_(ForceBasis::gauss(stages)),
      nodes_(hermite_nodes(basis_.points))
{
  const Index n = 2 * context.measures.n_p;
  for (VectorXd *x : {&x_begin_, &x_end_})
    x->setZero(n);
  for (VectorXd *x : {&P_, &P_last_, &residual_})
    x->setZero(s_ * n_u_);
  free_.setZero((s_ + 1) * 2 * n_u_);
  U_.setZero(n_u_, s_ + 2);
  V_.setZero(n_u_, s_ + 2);
  dp_du_.setZero(n_u_, n_u_);
  dp_dv_.setZero(n_u_, n_u_);
  for (VectorXd *x : {&P_end_, &defect_, &defect_begin_, &largest_defect_})
    x->setZero(n_u_);
  for (Reach *reach : {&reached_, &expected_})
  {
    reach->u.setZero(n_u_);
    reach->p.setZero(n_u_);
  }
  node_.resize(*context.system);
  lu_.resize(s_ * n_u_);
  sound_.resize(s_ * n_u_);
  extrapolate_.setZero(s_, s_);
  for (int j = 0; j < s_; ++j)
  {
    at_begin_.push_back(basis_.value(j, 0.));
    at_end_.push_back(basis_.value(j, 1.));
  }
}

void CollocationStep::begin(const VectorXd &x, const LocalState &at)
{
  x_begin_  = x;
  begin_at_ = at;
  context_.grow_scale(context_.scale, at.u, at.v, 0.);
  if (context_.force.isZero(0.)) // another motion
  {
    largest_defect_.setZero();
    defect_part_ = 1.;
  }
  context_.force  = context_.force.cwiseMax(at.p.cwiseAbs());
  tried_          = nullptr;
  expected_until_ = -std::numeric_limits<double>::infinity();
  h_last_         = 0.;
  factors_        = nullptr;
  doubtful_       = 0;
  context_.mobile_parts(at.t, mobile_);
}

bool CollocationStep::solve(const StepTable &table, LocalState &end)
{
  constexpr int most_doubtful = 6; // halvings: a 64th of the step
  // A step tried from here before was rejected.  It predicts the distance of the motion at its end, which is a lower
  // bound of the scales until then: a motion from rest, like t^3, would otherwise have no step small enough.  A step
  // with an error as large as its motion is no prediction, unless shorter ones are the same.
  if (tried_ && begin_at_.t + h_ > expected_until_ && (error_ < 1. || ++doubtful_ > most_doubtful) && is_sound(*tried_))
  {
    expected_       = reached_;
    expected_until_ = begin_at_.t + h_;
  }
  tried_          = nullptr;
  free_.noalias() = table.rows.transpose() * x_begin_;
  free_ += table.row_constant;
  predict(table.h);
  if (!iterate(table))
  {
    factors_ = nullptr;
    return false;
  }
  table.carry(x_begin_, x_end_);
  x_end_ += table.constant;
  x_end_.noalias() += table.in * P_;
  motion(table, s_, end);
  if (!context_.system->forces().held().empty())
    context_.project_held(x_end_, end);
  finish(table, end);
  tried_ = &table;
  return true;
}

void CollocationStep::accept()
{
  x_begin_.swap(x_end_);
  context_.grow_scale(context_.scale, U_.col(s_ + 1), V_.col(s_ + 1), h_);
  context_.force = context_.force.cwiseMax(reached_.p);
  note_defect();
  context_.farthest = std::max(context_.farthest, reached_.way);
  tried_            = nullptr;
  doubtful_         = 0;
  begin_at_.u       = U_.col(s_ + 1);
  begin_at_.v       = V_.col(s_ + 1);
  begin_at_.p       = P_end_;
  begin_at_.t += h_;
  P_last_ = P_;
  h_last_ = h_;
}

void CollocationStep::interpolate(double sigma, LocalState &state) const
{
  double value[HermiteNodes::max_nodes], slope[HermiteNodes::max_nodes];
  double rate_value[HermiteNodes::max_nodes], rate_slope[HermiteNodes::max_nodes];
  nodes_.weights(sigma, value, slope, rate_value, rate_slope);
  state.u.setZero();
  state.v.setZero();
  state.a.setZero();
  state.p.setZero();
  for (int i = 0; i < nodes_.size(); ++i)
  {
    state.u += value[i] * U_.col(i) + (h_ * slope[i]) * V_.col(i);
    state.v += (rate_value[i] / h_) * U_.col(i) + rate_slope[i] * V_.col(i);
  }
  for (int j = 0; j < s_; ++j)
    state.p += basis_.value(j, sigma) * P_.segment(j * n_u_, n_u_);
}

HermiteNodes CollocationStep::hermite_nodes(std::vector<double> points)
{
  points.insert(points.begin(), 0.);
  return HermiteNodes(points);
}

void CollocationStep::motion(const StepTable &table, int i, LocalState &state) const
{
  state.u = free_.segment(2 * i * n_u_, n_u_);
  state.v = free_.segment((2 * i + 1) * n_u_, n_u_);
  state.u.noalias() += table.S_u.middleRows(i * n_u_, n_u_).lazyProduct(P_);
  state.v.noalias() += table.S_v.middleRows(i * n_u_, n_u_).lazyProduct(P_);
}

void CollocationStep::predict(double h)
{
  if (h_last_ == 0.)
  {
    for (int i = 0; i < s_; ++i)
      P_.segment(i * n_u_, n_u_) = begin_at_.p;
    return;
  }
  const double ratio = h / h_last_;
  if (ratio != ratio_)
  {
    ratio_ = ratio;
    for (int i = 0; i < s_; ++i)
      for (int j = 0; j < s_; ++j)
        extrapolate_(i, j) = basis_.value(j, 1. + basis_.points[i] * ratio);
  }
  for (int i = 0; i < s_; ++i)
  {
    auto P = P_.segment(i * n_u_, n_u_);
    P.setZero();
    for (int j = 0; j < s_; ++j)
      P += extrapolate_(i, j) * P_last_.segment(j * n_u_, n_u_);
  }
}

void CollocationStep::fill_rows(const StepTable &table, int i, MatrixXd &matrix) const
{
  auto rows      = matrix.middleRows(i * n_u_, n_u_);
  rows.noalias() = -dp_du_.lazyProduct(table.S_u.middleRows(i * n_u_, n_u_));
  rows.noalias() -= dp_dv_.lazyProduct(table.S_v.middleRows(i * n_u_, n_u_));
}

bool CollocationStep::evaluate(const StepTable &table, bool jacobian)
{
  const SecondOrderSystem &system = *context_.system;
  for (int i = 0; i < s_; ++i)
  {
    motion(table, i, node_);
    node_.t = begin_at_.t + basis_.points[i] * table.h;
    node_.p = P_.segment(i * n_u_, n_u_);
    if (jacobian)
    {
      system.forces().derivatives(node_, node_.p, dp_du_, dp_dv_);
      fill_rows(table, i, lu_.matrix());
    }
    else
      system.forces().force(node_, node_.p);
    residual_.segment(i * n_u_, n_u_) = node_.p - P_.segment(i * n_u_, n_u_);
    U_.col(i + 1)                     = node_.u;
    V_.col(i + 1)                     = node_.v;
  }
  context_.work.evaluations += s_;
  if (jacobian)
    lu_.matrix().diagonal().array() += 1.;
  for (const HeldMeasure &held : system.forces().held())
    for (int i = 0; i < s_; ++i)
    {
      // Per h: S_v ~ h W^T M^-1 W, and a step to an event may be as short as the resolution of time.
      const int row  = i * n_u_ + held.measure;
      residual_[row] = (held.rate - V_(held.measure, i + 1)) / table.h;
      if (jacobian)
        lu_.matrix().row(row) = table.S_v.row(row) / table.h;
    }
  if (!jacobian)
    return true;
  ++context_.work.newton;
  factors_   = &table;
  factors_h_ = table.h;
  return lu_.factorise(!context_.system->forces().held().empty());
}

bool CollocationStep::iterate(const StepTable &table)
{
  const bool keep   = factors_ == &table && factors_h_ == table.h;
  bool       fresh  = !keep;
  double     before = 0.;
  for (int iteration = 0; iteration < context_.newton.max_iterations; ++iteration)
  {
    if (!evaluate(table, fresh))
      return false;
    lu_.solve_in_place(residual_);
    grow_scale(U_.col(1), V_.col(1), table.h);
    P_ += residual_;
    double       part;
    const double size = size_of(table, residual_, iteration, part);
    if (!std::isfinite(size))
      return false;
    const double contraction = iteration > 0 && before > 0. ? size / before : 0.01;
    const double left        = contraction < 1. ? contraction / (1. - contraction) : 1.;
    const double known       = iteration > 0 ? std::min(1., left) : 1.; // of the correction, that may be left
    // contraction above which corrections are rounding: Newton's converge faster
    constexpr double stalled = 0.5;
    if (size * known <= context_.newton.tolerance && (part * known <= part_left() || contraction > stalled))
      return true;
    constexpr double fresh_needed = 0.15; // contraction above which the Jacobian is computed again
    // A kept Jacobian with bad contraction is computed again; a fresh one from its second use.
    fresh  = iteration > 0 ? contraction > fresh_needed : false;
    before = size;
  }
  return false;
}

std::unique_ptr<ForceStep> make_collocation_step(PropagationContext &context, int stages)
{
  return std::make_unique<CollocationStep>(context, stages);
}

void CollocationStep::exchange(StateArchive &archive, const std::vector<const StepTable *> &tables)
{
  for (const StepTable **table : {&tried_, &factors_})
    exchange_table(archive, tables, *table);
  archive(x_begin_, x_end_, free_, P_, P_last_, P_end_, residual_, defect_, defect_begin_, mobile_, scale_,
          age_of_way_);
  for (Reach *reach : {&reached_, &expected_})
    archive(reach->u, reach->p, reach->way);
  archive(expected_until_, doubtful_, largest_defect_, defect_part_, U_, V_, dp_du_, dp_dv_, extrapolate_, begin_at_,
          node_, lu_, factors_h_, h_, h_last_, ratio_, error_);
}

} // namespace gestell::coupling
