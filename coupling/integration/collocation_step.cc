#include "coupling/integration/force_step.h"

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

constexpr double fresh_needed = 0.15; ///< contraction above which the Jacobian is taken anew
constexpr int    error_share  = 10;   ///< the defect at the end of a step against what it does to the measures

/**
 * Forces as the polynomial through s Gauss points, at which the laws are met:
 *
 *     p_i = phi(u_i, u'_i),   u_i = u_free(c_i) + sum_j S_u(i, j) p_j,   u'_i = u'_free(c_i) + sum_j S_v(i, j) p_j.
 *
 * Order 2 s at the ends of steps, as the error of the polynomial is orthogonal to all of degree s - 1.  Newton solves
 * for all p_i at once and keeps its Jacobian as long as it contracts well.
 */
class CollocationStep final : public ForceStep
{
public:
  CollocationStep(ExactContext &context, int stages)
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
    P_end_.setZero(n_u_);
    defect_.setZero(n_u_);
    node_.resize(*context.system);
    lu_.resize(s_ * n_u_);
    extrapolate_.setZero(s_, s_);
    for (int j = 0; j < s_; ++j)
      at_end_.push_back(basis_.value(j, 1.));
  }

  const ForceBasis &basis() const override { return basis_; }

  void begin(const VectorXd &x, const LocalState &at) override
  {
    x_begin_  = x;
    begin_at_ = at;
    context_.grow_scale(context_.scale, at.u, at.v, 0.);
    tried_          = false;
    expected_until_ = -std::numeric_limits<double>::infinity();
    h_last_         = 0.;
    factors_        = nullptr;
  }

  bool solve(const StepTable &table, LocalState &end) override
  {
    // A step tried from here before was refused.  But it tells how far the motion goes by its end, and until then
    // scales are not below that: a motion that begins from rest, like t^3, would else have no step small enough.
    if (tried_ && lu_.least_pivot() > 0.25 && begin_at_.t + h_ > expected_until_)
    {
      expected_       = reached_;
      expected_until_ = begin_at_.t + h_;
    }
    tried_          = false;
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
    if (!context_.system->held().empty())
      context_.project_held(x_end_, end);
    finish(table, end);
    reached_ = context_.scale;
    context_.grow_scale(reached_, end.u, end.v, table.h);
    tried_ = true;
    return true;
  }

  void accept() override
  {
    x_begin_.swap(x_end_);
    context_.scale = reached_;
    tried_         = false;
    begin_at_.u    = U_.col(s_ + 1);
    begin_at_.v    = V_.col(s_ + 1);
    begin_at_.p    = P_end_;
    begin_at_.t += h_;
    P_last_ = P_;
    h_last_ = h_;
  }

  void   begin_state(VectorXd &x) const override { x = x_begin_; }
  void   end_state(VectorXd &x) const override { x = x_end_; }
  void   forces(VectorXd &p) const override { p = P_; }
  double error() const override { return error_; }
  int    error_order() const override { return s_ + 2; }

  void interpolate(double sigma, LocalState &state) const override
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

private:
  static HermiteNodes hermite_nodes(std::vector<double> points)
  {
    points.insert(points.begin(), 0.);
    return HermiteNodes(points);
  }

  /// u, v at point i from the free motion and P.
  void motion(const StepTable &table, int i, LocalState &state) const
  {
    state.u = free_.segment(2 * i * n_u_, n_u_);
    state.v = free_.segment((2 * i + 1) * n_u_, n_u_);
    state.u.noalias() += table.S_u.middleRows(i * n_u_, n_u_).lazyProduct(P_);
    state.v.noalias() += table.S_v.middleRows(i * n_u_, n_u_).lazyProduct(P_);
  }

  /// The last step's polynomial goes on; behind an event the force at its begin does.
  void predict(double h)
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

  /// Residuals phi(u_i, v_i) - P_i; with their Jacobian if it is wanted.
  bool evaluate(const StepTable &table, bool jacobian)
  {
    const SecondOrderSystem &system = *context_.system;
    for (int i = 0; i < s_; ++i)
    {
      motion(table, i, node_);
      node_.t = begin_at_.t + basis_.points[i] * table.h;
      node_.p = P_.segment(i * n_u_, n_u_);
      if (jacobian)
      {
        system.local_derivatives(node_, node_.p, dp_du_, dp_dv_);
        lu_.matrix().middleRows(i * n_u_, n_u_).noalias() = -dp_du_.lazyProduct(table.S_u.middleRows(i * n_u_, n_u_));
        lu_.matrix().middleRows(i * n_u_, n_u_).noalias() -= dp_dv_.lazyProduct(table.S_v.middleRows(i * n_u_, n_u_));
      }
      else
        system.local_force(node_, node_.p);
      residual_.segment(i * n_u_, n_u_) = node_.p - P_.segment(i * n_u_, n_u_);
      U_.col(i + 1)                     = node_.u;
      V_.col(i + 1)                     = node_.v;
    }
    context_.work.evaluations += s_;
    if (jacobian)
      lu_.matrix().diagonal().array() += 1.;
    for (const HeldMeasure &held : system.held())
      for (int i = 0; i < s_; ++i)
      {
        const int row  = i * n_u_ + held.measure;
        residual_[row] = held.rate - V_(held.measure, i + 1);
        if (jacobian)
          lu_.matrix().row(row) = table.S_v.row(row);
      }
    if (!jacobian)
      return true;
    ++context_.work.newton;
    factors_   = &table;
    factors_h_ = table.h;
    return lu_.factorise(!context_.system->held().empty());
  }

  bool iterate(const StepTable &table)
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
      const double size = size_of(table, residual_);
      if (!std::isfinite(size))
        return false;
      P_ += residual_;
      const double contraction = iteration > 0 && before > 0. ? size / before : 0.01;
      const double remaining   = contraction < 1. ? size * contraction / (1. - contraction) : size;
      if (size <= context_.newton.tolerance || (iteration > 0 && remaining <= context_.newton.tolerance))
        return true;
      // A kept Jacobian that contracts badly is taken anew; a fresh one is, from its second use on.
      fresh  = iteration > 0 ? contraction > fresh_needed : false;
      before = size;
    }
    return false;
  }

  /// The excursions of accepted steps, of this iterate, and those to be expected.
  void grow_scale(const Eigen::Ref<const VectorXd> &u, const Eigen::Ref<const VectorXd> &v, double h)
  {
    scale_ = context_.scale;
    if (begin_at_.t + h <= expected_until_)
      scale_ = scale_.cwiseMax(expected_);
    context_.grow_scale(scale_, u, v, h);
  }

  /// What a change of the forces does to the measures, relative to their scales.
  double size_of(const StepTable &table, const VectorXd &change) const
  {
    double size = 0.;
    for (int i = 0; i < s_; ++i)
      for (int r = 0; r < n_u_; ++r)
      {
        const int    row = i * n_u_ + r;
        const double du =
            std::max(std::abs(table.S_u(row, row)), table.h * std::abs(table.S_v(row, row))) * std::abs(change[row]);
        if (du != 0.)
          size = std::max(size, du / std::max(scale_[r], du));
      }
    return size;
  }

  void finish(const StepTable &table, LocalState &end)
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
    context_.system->local_force(end, end.p);
    ++context_.work.evaluations;
    if (!context_.system->held().empty())
      context_.accelerate(x_end_,
                          end); // so that the guards of what sticks see its force with the accuracy of the state
    U_.col(s_ + 1) = end.u;
    V_.col(s_ + 1) = end.v;
    defect_        = end.p - P_end_;
    P_end_         = end.p;
    grow_scale(end.u, end.v, table.h);
    error_           = 0.;
    const Index last = s_ * n_u_;
    for (int r = 0; r < n_u_; ++r)
    {
      double S_u = 0., S_v = 0.;
      for (int j = 0; j < s_; ++j)
      {
        S_u += table.S_u(last + r, j * n_u_ + r);
        S_v += table.S_v(last + r, j * n_u_ + r);
      }
      const double du = std::max(std::abs(S_u), table.h * std::abs(S_v)) * std::abs(defect_[r]) / error_share;
      if (du != 0.)
        error_ = std::max(error_, du / std::max(scale_[r], du));
    }
  }

  ExactContext       &context_;
  int                 s_, n_u_;
  ForceBasis          basis_;
  HermiteNodes        nodes_;
  VectorXd            x_begin_, x_end_, free_, P_, P_last_, P_end_, residual_, defect_;
  VectorXd            scale_, reached_, expected_; ///< [n_u] of the step in work; by its end; by the end of one refused
  double              expected_until_ = 0.;
  bool                tried_          = false; ///< a step from the present begin
  MatrixXd            U_, V_, dp_du_, dp_dv_, extrapolate_;
  std::vector<double> at_end_;
  LocalState          begin_at_, node_;
  SmallLu             lu_;
  const StepTable    *factors_   = nullptr;
  double              factors_h_ = 0.;
  double              h_ = 0., h_last_ = 0., ratio_ = 0., error_ = 0.;
};

} // namespace

std::unique_ptr<ForceStep> make_collocation_step(ExactContext &context, int stages)
{
  return std::make_unique<CollocationStep>(context, stages);
}

} // namespace gestell::coupling
