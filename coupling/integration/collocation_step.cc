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

constexpr double fresh_needed  = 0.15; ///< contraction above which the Jacobian is taken anew
constexpr int    error_share   = 10;   ///< the defect at the end of a step against what it does to the measures
constexpr double rounding      = 8. * std::numeric_limits<double>::epsilon();
constexpr double least_pivot   = 0.25; ///< of I - S dp: its solution goes at most some four times as far as the motion
constexpr double least_part    = 1e-6; ///< of the motion as a whole, below which a measure does not count for less
constexpr int    most_usual    = 2;    ///< iterations
constexpr int    steps_of_way  = 16;   ///< between two looks at the way of the motion
constexpr int    most_doubtful = 6;    ///< halvings
constexpr double stalled       = 0.5;  ///< contraction above which corrections are rounding
constexpr double newton_share  = 1e-2; ///< of the square of the defect, which is of the order of the local error
constexpr double least_part_left = 1e-11; ///< of the forces: over a hundred periods 1e-9 of the motion

/**
 * Forces as the polynomial through s Gauss points, at which the laws are met:
 *
 *     p_i = phi(u_i, u'_i),   u_i = u_free(c_i) + sum_j S_u(i, j) p_j,   u'_i = u'_free(c_i) + sum_j S_v(i, j) p_j.
 *
 * Order 2 s at the ends of steps, as the error of the polynomial is orthogonal to all of degree s - 1.  Newton solves
 * for all p_i at once and keeps its Jacobian as long as it contracts well.  It stops where what it leaves moves no
 * measure by the tolerance, relative to its largest excursion, and from order 6 on is small beside the local error:
 * forces are met to newton_share times the square of the relative defect of the polynomial at the end of the step
 * before.
 *
 * Error.  The defect d of the law at the end of the step would, acting all the step, move the measures by S d.  A tenth
 * of that is compared with their largest excursions, which do not count for less than least_part of how far the motion
 * as a whole has gone, or loads to come would lead it, in the norm of the energy.  What sticks holds others too: S is
 * what is left of the mobility then.  A measure that sticks does not move: its force is as good as it should be if it
 * errs little beside its own largest value, or if the error moves little beside the motion as a whole.
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
    for (VectorXd *x : {&P_end_, &defect_, &largest_defect_})
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
      at_end_.push_back(basis_.value(j, 1.));
  }

  const ForceBasis &basis() const override { return basis_; }

  void begin(const VectorXd &x, const LocalState &at) override
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

  bool solve(const StepTable &table, LocalState &end) override
  {
    // A step tried from here before was refused.  But it tells how far the motion goes by its end, and until then
    // scales are not below that: a motion that begins from rest, like t^3, would else have no step small enough.
    // One that errs by as much as it moves tells little, unless shorter ones do so too.
    if (tried_ && begin_at_.t + h_ > expected_until_ && (error_ < 1. || ++doubtful_ > most_doubtful) &&
        is_sound(*tried_))
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
    if (!context_.system->held().empty())
      context_.project_held(x_end_, end);
    finish(table, end);
    tried_ = &table;
    return true;
  }

  void accept() override
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
      P_ += residual_;
      double       part;
      const double size = size_of(table, residual_, iteration, part);
      if (!std::isfinite(size))
        return false;
      const double contraction = iteration > 0 && before > 0. ? size / before : 0.01;
      const double left        = contraction < 1. ? contraction / (1. - contraction) : 1.;
      const double known       = iteration > 0 ? std::min(1., left) : 1.; // of the correction, that may be left
      if (size * known <= context_.newton.tolerance && (part * known <= part_left() || contraction > stalled))
        return true;
      // A kept Jacobian that contracts badly is taken anew; a fresh one is, from its second use on.
      fresh  = iteration > 0 ? contraction > fresh_needed : false;
      before = size;
    }
    return false;
  }

  /// The largest defects so far, as parts of the largest forces.
  void note_defect()
  {
    largest_defect_ = largest_defect_.cwiseMax(defect_.cwiseAbs());
    defect_part_    = 0.;
    for (int r = 0; r < n_u_; ++r)
      if (context_.force[r] > 0.)
        defect_part_ = std::max(defect_part_, std::min(1., largest_defect_[r] / context_.force[r]));
  }

  /// Relative error of the forces that Newton may leave; up to order 4 the tolerance is small enough beside the error.
  double part_left() const
  {
    if (s_ < 3 || context_.newton.share_of_error == 0.)
      return 1.;
    return std::max(newton_share * defect_part_ * defect_part_, least_part_left);
  }

  bool is_expected(double h) const { return begin_at_.t + h <= expected_until_; }

  /// The excursions of accepted steps, of this iterate, and those to be expected.
  void grow_scale(const Eigen::Ref<const VectorXd> &u, const Eigen::Ref<const VectorXd> &v, double h)
  {
    scale_ = context_.scale;
    if (is_expected(h))
      scale_ = scale_.cwiseMax(expected_.u);
    context_.grow_scale(scale_, u, v, h);
  }

  bool is_held(int measure) const
  {
    for (const HeldMeasure &held : context_.system->held())
      if (held.measure == measure)
        return true;
    return false;
  }

  /// What a change of the forces does to the measures, relative to their scales; what sticks, to what its force does.
  /// Forces that balance each other leave rounding of what each would do alone, which shows where iterations do not
  /// end.
  /// @param part  the change, relative to the largest forces
  double size_of(const StepTable &table, const VectorXd &change, int iteration, double &part) const
  {
    const double left = iteration < most_usual ? 0. : rounding / context_.newton.tolerance;
    double       size = 0.;
    part              = 0.;
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

  /// What all forces would move a measure together, were they not to balance each other.
  double of_all(const StepTable &table, int row) const
  {
    double sum = 0.;
    for (int k = 0; k < P_.size(); ++k)
      sum += std::max(std::abs(table.S_u(row, k)), table.h * std::abs(table.S_v(row, k))) * std::abs(P_[k]);
    return sum;
  }

  /// Of I - S dp at the begin of the step, what sticks left out: no pivot is small or negative.
  bool is_sound(const StepTable &table)
  {
    if (context_.system->held().empty())
      return lu_.least_pivot() > least_pivot;
    dp_du_.setZero(); // what sticks writes nothing
    dp_dv_.setZero();
    defect_ = begin_at_.p;
    context_.system->local_derivatives(begin_at_, defect_, dp_du_, dp_dv_);
    ++context_.work.evaluations;
    for (int i = 0; i < s_; ++i)
    {
      auto rows      = sound_.matrix().middleRows(i * n_u_, n_u_);
      rows.noalias() = -dp_du_.lazyProduct(table.S_u.middleRows(i * n_u_, n_u_));
      rows.noalias() -= dp_dv_.lazyProduct(table.S_v.middleRows(i * n_u_, n_u_));
    }
    for (const HeldMeasure &held : context_.system->held())
      for (int i = 0; i < s_; ++i)
      {
        sound_.matrix().row(i * n_u_ + held.measure).setZero();
        sound_.matrix().col(i * n_u_ + held.measure).setZero();
      }
    sound_.matrix().diagonal().array() += 1.;
    return sound_.factorise(false) && sound_.least_pivot() > least_pivot;
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
    reach(end);
    grow_scale(end.u, end.v, table.h);
    estimate(table);
    // The way of the motion costs a pass over the modes: it is looked at where it may save the step, else now and then.
    if (context_.error_tolerance == 0. || (error_ <= context_.error_tolerance && age_of_way_++ % steps_of_way != 0))
      return;
    reached_.way = context_.way(x_end_);
    estimate(table);
  }

  /// How far the measures and their forces go in the step.
  void reach(const LocalState &end)
  {
    reached_.u   = context_.scale.cwiseMax((end.u - context_.u_begin).cwiseAbs());
    reached_.p   = end.p.cwiseAbs();
    reached_.way = 0.;
  }

  /// error_ of the step, and the part of the forces that the defect is.
  void estimate(const StepTable &table)
  {
    const bool   expected = is_expected(table.h);
    const double way =
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
      const double defect = std::abs(defect_[r]) / error_share, whole = way * context_.root_mobility[r];
      const double du = std::max(std::abs(S_u), table.h * std::abs(S_v)) * defect * (is_held(r) ? 1. : mobile_[r]);
      if (du == 0.)
        continue;
      const double force = std::max({context_.force[r], reached_.p[r], expected ? expected_.p[r] : 0.});
      if (is_held(r))
        error_ = std::max(error_, std::min(defect / std::max(force, defect), du / std::max(whole, du)));
      else
        error_ = std::max(error_, du / std::max({scale_[r], least * context_.root_mobility[r], du}));
    }
  }

  /// Largest excursions of the measures, their forces, and the way of the motion as a whole.
  struct Reach
  {
    VectorXd u, p;
    double   way = 0.;
  };

  ExactContext       &context_;
  int                 s_, n_u_;
  ForceBasis          basis_;
  HermiteNodes        nodes_;
  VectorXd            x_begin_, x_end_, free_, P_, P_last_, P_end_, residual_, defect_;
  VectorXd            mobile_; ///< what is left of the mobility of a measure while others are held [n_u]
  VectorXd            scale_;  ///< of the measures in the step in work [n_u]
  long                age_of_way_ = 0;
  Reach               reached_, expected_; ///< by the end of the step in work; of one refused
  double              expected_until_ = 0.;
  int                 doubtful_       = 0;    ///< steps refused from the present begin that erred by all they moved
  VectorXd            largest_defect_;        ///< of the forces so far [n_u]
  double              defect_part_ = 1.;      ///< the largest of them, as a part of the largest force
  const StepTable    *tried_       = nullptr; ///< of a step from the present begin
  MatrixXd            U_, V_, dp_du_, dp_dv_, extrapolate_;
  std::vector<double> at_end_;
  LocalState          begin_at_, node_;
  SmallLu             lu_, sound_;
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
