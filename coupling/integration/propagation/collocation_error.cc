#include "coupling/integration/propagation/collocation_step.h"

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

void CollocationStep::note_defect()
{
  largest_defect_ = largest_defect_.cwiseMax(defect_.cwiseAbs());
  defect_part_    = 0.;
  for (int r = 0; r < n_u_; ++r)
    if (context_.force[r] > 0.)
      defect_part_ = std::max(defect_part_, std::min(1., largest_defect_[r] / context_.force[r]));
}

double CollocationStep::part_left() const
{
  if (s_ < 3 || context_.newton.share_of_error == 0.)
    return 1.;
  constexpr double newton_share    = 1e-2;  // of the square of the defect, which is of the order of the local error
  constexpr double least_part_left = 1e-11; // of the forces: over a hundred periods 1e-9 of the motion
  return std::max(newton_share * defect_part_ * defect_part_, least_part_left);
}

void CollocationStep::grow_scale(const Eigen::Ref<const VectorXd> &u, const Eigen::Ref<const VectorXd> &v, double h)
{
  scale_ = context_.scale;
  if (is_expected(h))
    scale_ = scale_.cwiseMax(expected_.u);
  context_.grow_scale(scale_, u, v, h);
}

bool CollocationStep::is_held(int measure) const
{
  for (const HeldMeasure &held : context_.system->forces().held())
    if (held.measure == measure)
      return true;
  return false;
}

double CollocationStep::size_of(const StepTable &table, const VectorXd &change, int iteration, double &part) const
{
  constexpr double rounding   = 8. * std::numeric_limits<double>::epsilon(); // of sums of a few terms
  constexpr int    most_usual = 2;                                           // iterations: one corrects, one confirms
  const double     left       = iteration < most_usual ? 0. : rounding / context_.newton.tolerance;
  double           size       = 0.;
  part                        = 0.;
  for (int r = 0; r < n_u_; ++r)
  {
    const double own = is_held(r) ? 1. : 0.;
    for (int i = 0; i < s_; ++i)
    {
      const int    row = i * n_u_ + r;
      const double S   = std::max(std::abs(table.S_u(row, row)), table.h * std::abs(table.S_v(row, row)));
      const double du  = S * std::abs(change[row]);
      if (du == 0.)
        continue;
      double scale = std::max({scale_[r], own * S * std::abs(P_[row]), du});
      if (left > 0.)
        scale = std::max(scale, left * of_all(table, row));
      size = std::max(size, du / scale);
      if (du > rounding * std::abs(U_(r, i + 1)))
        part = std::max(part, std::abs(change[row]) / std::max(context_.force[r], std::abs(P_[row])));
    }
  }
  return size;
}

double CollocationStep::of_all(const StepTable &table, int row) const
{
  double sum = 0.;
  for (int k = 0; k < P_.size(); ++k)
    sum += std::max(std::abs(table.S_u(row, k)), table.h * std::abs(table.S_v(row, k))) * std::abs(P_[k]);
  return sum;
}

bool CollocationStep::is_sound(const StepTable &table)
{
  constexpr double least_pivot = 0.25; // of I - S dp: its solution is at most about four times as large as the motion
  if (context_.system->forces().held().empty())
    return lu_.least_pivot() > least_pivot;
  dp_du_.setZero(); // sticking measures write nothing
  dp_dv_.setZero();
  defect_ = begin_at_.p;
  context_.system->forces().derivatives(begin_at_, defect_, dp_du_, dp_dv_);
  ++context_.work.evaluations;
  for (int i = 0; i < s_; ++i)
  {
    auto rows      = sound_.matrix().middleRows(i * n_u_, n_u_);
    rows.noalias() = -dp_du_.lazyProduct(table.S_u.middleRows(i * n_u_, n_u_));
    rows.noalias() -= dp_dv_.lazyProduct(table.S_v.middleRows(i * n_u_, n_u_));
  }
  for (const HeldMeasure &held : context_.system->forces().held())
    for (int i = 0; i < s_; ++i)
    {
      sound_.matrix().row(i * n_u_ + held.measure).setZero();
      sound_.matrix().col(i * n_u_ + held.measure).setZero();
    }
  sound_.matrix().diagonal().array() += 1.;
  return sound_.factorise(false) && sound_.least_pivot() > least_pivot;
}

void CollocationStep::finish(const StepTable &table, LocalState &end)
{
  h_        = table.h;
  U_.col(0) = begin_at_.u;
  V_.col(0) = begin_at_.v;
  end.t     = begin_at_.t + h_;
  P_end_.setZero();
  for (int j = 0; j < s_; ++j)
    P_end_ += at_end_[j] * P_.segment(j * n_u_, n_u_);
  end.a.setZero();
  end.p = P_end_;
  context_.system->forces().force(end, end.p);
  ++context_.work.evaluations;
  if (!context_.system->forces().held().empty())
    context_.accelerate(x_end_,
                        end); // so that sticking guards use the force at the accuracy of the state
  U_.col(s_ + 1) = end.u;
  V_.col(s_ + 1) = end.v;
  find_defect(end);
  P_end_ = end.p;
  reach(end);
  grow_scale(end.u, end.v, table.h);
  estimate(table);
  constexpr int steps_of_way = 16; // between two calls of way(), each a few products
  // way() costs a pass over the modes: it is evaluated if it may prevent a rejection, otherwise only sometimes.
  if (context_.error_tolerance == 0. || (error_ <= context_.error_tolerance && age_of_way_++ % steps_of_way != 0))
    return;
  reached_.way = context_.way(x_end_);
  estimate(table);
}

/// Defect of the law at both ends of the step: equal in smooth motion, because the Gauss points are symmetric.  If a
/// step is too long for its motion either of them may be small by coincidence.
void CollocationStep::find_defect(const LocalState &end)
{
  defect_begin_ = begin_at_.p;
  for (int j = 0; j < s_; ++j)
    defect_begin_ -= at_begin_[j] * P_.segment(j * n_u_, n_u_);
  defect_ = (end.p - P_end_).cwiseAbs().cwiseMax(defect_begin_.cwiseAbs());
}

void CollocationStep::reach(const LocalState &end)
{
  reached_.u   = context_.scale.cwiseMax((end.u - context_.u_begin).cwiseAbs());
  reached_.p   = end.p.cwiseAbs();
  reached_.way = 0.;
}

void CollocationStep::estimate(const StepTable &table)
{
  const bool       expected   = is_expected(table.h);
  constexpr double least_part = 1e-6; // of the whole motion: least scale of a measure
  const double     way =
      std::max({context_.farthest, reached_.way, expected ? expected_.way : 0., least_part * context_.loads_way});
  const double least = least_part * std::max(way, context_.loads_way);
  const Index  last  = s_ * n_u_;
  error_             = 0.;
  for (int r = 0; r < n_u_; ++r)
  {
    double S_u = 0., S_v = 0.;
    for (int j = 0; j < s_; ++j)
    {
      S_u += table.S_u(last + r, j * n_u_ + r);
      S_v += table.S_v(last + r, j * n_u_ + r);
    }
    constexpr int error_share = 10; // the defect at the ends of a step against what it does to the measures
    const double  defect = std::abs(defect_[r]) / error_share, whole = way * context_.root_mobility[r];
    const double  du = std::max(std::abs(S_u), table.h * std::abs(S_v)) * defect * (is_held(r) ? 1. : mobile_[r]);
    if (du == 0.)
      continue;
    const double force = std::max({context_.force[r], reached_.p[r], expected ? expected_.p[r] : 0.});
    if (is_held(r))
      error_ = std::max(error_, std::min(defect / std::max(force, defect), du / std::max(whole, du)));
    else
      error_ = std::max(error_, du / std::max({scale_[r], least * context_.root_mobility[r], du}));
  }
}

} // namespace gestell::coupling
