#include "coupling/integration/propagation/force_step.h"
#include "coupling/integration/propagation/fused_kernel.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double unknown_contraction = 1e-2; ///< assumed of Newton where it has not been seen, and at best

/**
 * One unknown force per measure and step: linear between the ends, or its mean along the way of the step.
 *
 * The state is kept without the share of the last force, x = y + g p, so that a step is one pass over the modes,
 *
 *     y_k+1 = E y_k + c + F p_k,     u_free = read^T y_k+1,     u_k+1 = u_free + S p_k+1,
 *
 * linear:   g = in_1, F = E in_1 + in_0, p the force at the end of the step;
 * average:  g = in_0, F = E in_0, p the force over the step, the mean of the law along the straight way from
 *           (u_k, u'_k) to (u_k+1, u'_k+1) by Gauss' rule.  As a constant force does the work p (u_k+1 - u_k) on the
 *           base system, which is carried exactly, a law with a potential gives and takes just what it stores: the step
 *           is stable at every contact.  Where a kink lies on the way, the mean is taken in many pieces.
 */
class FusedStep final : public ForceStep
{
public:
  FusedStep(PropagationContext &context, ForceRule rule)
      : context_(context), average_(rule == ForceRule::average), n_u_(int(context.measures.put.cols())),
        basis_(average_ ? ForceBasis::constant() : ForceBasis::linear()), nodes_({0., 1.})
  {
    const Index n = 2 * context.measures.n_p;
    for (VectorXd *x : {&y_begin_, &y_end_, &x_held_})
      x->setZero(n);
    for (VectorXd *x : {&p_begin_, &p_, &change_, &p_before_})
      x->setZero(n_u_);
    for (LocalState *state : {&at_begin_, &at_end_, &node_, &way_, &first_, &end_})
      state->resize(*context.system);
    free_.setZero(2 * n_u_);
    dp_du_.setZero(n_u_, n_u_);
    dp_dv_.setZero(n_u_, n_u_);
    dp_of_u_.setZero(n_u_, n_u_);
    dp_of_v_.setZero(n_u_, n_u_);
    S_u_.setZero(n_u_, n_u_);
    S_v_.setZero(n_u_, n_u_);
    F_.setZero(n, n_u_);
    read_.resize(n, 2 * n_u_);
    read_ << context.measures.read_u, context.measures.read_v;
    lu_.resize(n_u_);
  }

  const ForceBasis &basis() const override { return basis_; }

  void begin(const VectorXd &x, const LocalState &at) override
  {
    x_piece_  = x;
    at_begin_ = at;
    at_end_   = at;
    table_    = nullptr; // y is made when the table is known
    p_before_ = at.p;
  }

  void carry_tangents(Eigen::MatrixXd &) override
  {
    throw std::invalid_argument("tangents are carried with run.force = \"collocation\" only");
  }

  void exchange(StateArchive &archive, const std::vector<const StepTable *> &tables) override
  {
    exchange_table(archive, tables, table_);
    archive(h_, contraction_, y_begin_, y_end_, p_begin_, p_, p_before_, change_, free_, x_piece_, g_, F_, S_u_, S_v_,
            at_begin_, at_end_, node_);
  }

  bool solve(const StepTable &table, LocalState &end) override
  {
    if (&table != table_ || table.h != h_)
      take_table(table);
    node_.t = end_.t = at_end_.t = end.t = at_begin_.t + h_;
    const FusedPass pass{&table.E, &F_, &read_, &table.constant};
    run_pass(pass, y_begin_.data(), p_begin_.data());
    p_ = 2. * at_begin_.p - p_before_;
    if (average_)
      p_ = p_begin_;
    if (!iterate())
      return false;
    end.u = node_.u;
    end.v = node_.v;
    end.a.setZero();
    end.p = p_;
    if (average_)
    {
      context_.system->forces().force(end, end.p);
      ++context_.work.evaluations;
    }
    at_end_.u = end.u;
    at_end_.v = end.v;
    at_end_.p = end.p;
    if (!context_.system->forces().held().empty())
    {
      end_state(x_held_);
      context_.accelerate(x_held_, end); // the force of the step is a mean or swings about the one that holds
    }
    context_.grow_scale(context_.scale, end.u, end.v, h_);
    return true;
  }

  void accept() override
  {
    y_begin_.swap(y_end_);
    p_begin_  = p_;
    p_before_ = at_begin_.p;
    at_begin_.u.swap(at_end_.u);
    at_begin_.v.swap(at_end_.v);
    at_begin_.p.swap(at_end_.p);
    at_begin_.t = at_end_.t;
  }

  void begin_state(VectorXd &x) const override
  {
    if (table_)
      x = y_begin_ + g_ * p_begin_;
    else
      x = x_piece_;
  }
  void end_state(VectorXd &x) const override { x = y_end_ + g_ * p_; }
  void forces(VectorXd &p) const override
  {
    if (average_)
    {
      p = p_;
      return;
    }
    p.head(n_u_) = at_begin_.p;
    p.tail(n_u_) = p_;
  }

  void interpolate(double sigma, LocalState &state) const override
  {
    double value[2], slope[2], rate_value[2], rate_slope[2];
    nodes_.weights(sigma, value, slope, rate_value, rate_slope);
    state.u = value[0] * at_begin_.u + value[1] * at_end_.u + h_ * (slope[0] * at_begin_.v + slope[1] * at_end_.v);
    state.v = (1. / h_) * (rate_value[0] * at_begin_.u + rate_value[1] * at_end_.u) + rate_slope[0] * at_begin_.v +
              rate_slope[1] * at_end_.v;
    state.a.setZero();
    state.p = (1. - sigma) * at_begin_.p + sigma * at_end_.p;
  }

private:
  void take_table(const StepTable &table)
  {
    VectorXd &x = x_piece_;
    if (table_)
      x = y_begin_ + g_ * p_begin_;
    table_            = &table;
    h_                = table.h;
    const Index first = average_ ? 0 : n_u_;
    g_                = table.in.middleCols(first, n_u_);
    for (int j = 0; j < n_u_; ++j)
    {
      column_ = g_.col(j);
      moved_.resize(column_.size());
      table.carry(column_, moved_);
      F_.col(j) = moved_;
    }
    if (!average_)
      F_ += table.in.leftCols(n_u_);
    S_u_ = table.S_u.middleCols(first, n_u_);
    S_v_ = table.S_v.middleCols(first, n_u_);
    if (average_)
    {
      p_begin_.setZero();
      y_begin_ = x;
    }
    else
    {
      p_begin_ = at_begin_.p;
      y_begin_ = x - g_ * p_begin_;
    }
  }

  void run_pass(const FusedPass &pass, const double *y_0, const double *p)
  {
    double *y = y_end_.data(), *free = free_.data();
    switch (n_u_)
    {
    case 1:
      return fused_pass<1>(pass, y_0, p, y, free);
    case 2:
      return fused_pass<2>(pass, y_0, p, y, free);
    case 3:
      return fused_pass<3>(pass, y_0, p, y, free);
    case 4:
      return fused_pass<4>(pass, y_0, p, y, free);
    case 5:
      return fused_pass<5>(pass, y_0, p, y, free);
    case 6:
      return fused_pass<6>(pass, y_0, p, y, free);
    default:
      return fused_pass_any(pass, y_0, p, y, free);
    }
  }

  void motion()
  {
    node_.u = free_.head(n_u_);
    node_.v = free_.tail(n_u_);
    node_.u.noalias() += S_u_.lazyProduct(p_);
    node_.v.noalias() += S_v_.lazyProduct(p_);
  }

  /// Mean of the law and of its derivatives by the motion of the end of the way, in n pieces of two Gauss points.
  void mean_of_law(int n)
  {
    static constexpr double half = 0.28867513459481287; // sqrt(3)/6
    dp_du_.setZero();
    dp_dv_.setZero();
    change_.setZero();
    const double weight = 0.5 / n;
    for (int k = 0; k < n; ++k)
      for (const double point : {0.5 - half, 0.5 + half})
      {
        const double sigma = (k + point) / n;
        way_.t             = (1. - sigma) * at_begin_.t + sigma * node_.t;
        way_.u             = (1. - sigma) * at_begin_.u + sigma * node_.u;
        way_.v             = (1. - sigma) * at_begin_.v + sigma * node_.v;
        way_.p             = p_;
        context_.system->forces().derivatives(way_, way_.p, dp_of_u_, dp_of_v_);
        change_ += weight * way_.p;
        dp_du_ += (weight * sigma) * dp_of_u_;
        dp_dv_ += (weight * sigma) * dp_of_v_;
        if (n == 1 && point < 0.5)
          first_ = way_;
      }
    context_.work.evaluations += 2 * n;
  }

  bool is_held(int measure) const
  {
    for (const HeldMeasure &h : context_.system->forces().held())
      if (h.measure == measure)
        return true;
    return false;
  }

  /// After mean_of_law(1): the law at the ends of the way is not what its values and slope at the second Gauss point
  /// and the value at the first say of it, up to the second degree.
  bool kink_on_the_way()
  {
    end_.u = node_.u;
    end_.v = node_.v;
    end_.p = p_;
    context_.system->forces().force(end_, end_.p);
    ++context_.work.evaluations;
    // Parabola in sigma through both Gauss points with the slope at the second.
    static constexpr double distance = 0.57735026918962573, far = 0.21132486540518712; // of the points; to the near end
    for (int r = 0; r < n_u_; ++r)
    {
      if (is_held(r)) // its force is an unknown of the step and follows no law
        continue;
      double slope = 0.;
      for (int j = 0; j < n_u_; ++j)
        slope += dp_of_u_(r, j) * (node_.u[j] - at_begin_.u[j]) + dp_of_v_(r, j) * (node_.v[j] - at_begin_.v[j]);
      const double second = way_.p[r], bend = (first_.p[r] - second + slope * distance) / (distance * distance);
      const double at_end = second + slope * far + bend * far * far, way = 1. - far;
      const double at_begin = second - slope * way + bend * way * way;
      const double size =
          std::max({std::abs(first_.p[r]), std::abs(second), std::abs(end_.p[r]), std::abs(at_begin_.p[r])});
      constexpr double noticeable = 1e-2; // departure of a law from a parabola, relative to its force
      if (std::max(std::abs(at_end - end_.p[r]), std::abs(at_begin - at_begin_.p[r])) > noticeable * size)
        return true;
    }
    return false;
  }

  /// change = phi(u, u') - p and the matrix of its tangent.
  void evaluate()
  {
    const SecondOrderSystem &system = *context_.system;
    if (!average_)
    {
      change_ = p_;
      system.forces().derivatives(node_, change_, dp_du_, dp_dv_);
      ++context_.work.evaluations;
    }
    else
    {
      // Mean along the way by Gauss' rule; where a kink lies on it, in many short pieces.
      mean_of_law(1);
      constexpr int pieces_at_kinks = 128; // of the way of a step: the energy of a contact is met to some 1e-5
      if (kink_on_the_way())
        mean_of_law(pieces_at_kinks);
    }
    change_ -= p_;
    MatrixXd &J = lu_.matrix();
    J.noalias() = -dp_du_.lazyProduct(S_u_);
    J.noalias() -= dp_dv_.lazyProduct(S_v_);
    J.diagonal().array() += 1.;
    for (const HeldMeasure &held : system.forces().held())
    {
      change_[held.measure] = held.rate - node_.v[held.measure];
      J.row(held.measure)   = S_v_.row(held.measure);
    }
  }

  bool iterate()
  {
    if (n_u_ == 0)
      return true;
    double before = 0.;
    for (int iteration = 0; iteration < context_.newton.max_iterations; ++iteration)
    {
      motion();
      evaluate();
      ++context_.work.newton;
      if (!lu_.factorise(!context_.system->forces().held().empty()))
        return false;
      lu_.solve_in_place(change_);
      double size = 0.;
      for (int r = 0; r < n_u_; ++r)
      {
        if (is_held(r)) // linear in the forces: nothing to iterate, and a measure that never moved has no scale
          continue;
        const double du    = std::max(std::abs(S_u_(r, r)), h_ * std::abs(S_v_(r, r))) * std::abs(change_[r]);
        const double scale = std::max(context_.scale[r], h_ * std::abs(node_.v[r]));
        if (du != 0.)
          size = std::max(size, du / std::max(scale, du));
      }
      if (!std::isfinite(size))
        return false;
      // A correction that grows again jumps between the branches of a law: shorten it.
      const double damping = iteration > 7 && size > 0.5 * before ? 0.5 : 1.;
      p_ += damping * change_;
      if (iteration > 0 && before > 0.)
        contraction_ = std::clamp(size / before, 1e-4, 1.);
      const double remaining = contraction_ < 1. ? size * contraction_ / (1. - contraction_) : size;
      if (damping == 1. && (size <= context_.newton.tolerance || remaining <= context_.newton.tolerance))
      {
        contraction_ = std::max(contraction_, unknown_contraction);
        motion();
        return true;
      }
      before = size;
    }
    contraction_ = unknown_contraction;
    return false;
  }

  PropagationContext &context_;
  bool                average_;
  int                 n_u_;
  ForceBasis          basis_;
  HermiteNodes        nodes_;
  const StepTable    *table_ = nullptr;
  double              h_ = 0., contraction_ = unknown_contraction;
  VectorXd            y_begin_, y_end_, p_begin_, p_, p_before_, change_, free_, x_piece_, x_held_, column_, moved_;
  MatrixXd            g_, F_, read_, S_u_, S_v_, dp_du_, dp_dv_, dp_of_u_, dp_of_v_;
  LocalState          at_begin_, at_end_, node_, way_, first_, end_;
  SmallLu             lu_;
};

} // namespace

std::unique_ptr<ForceStep> make_fused_step(PropagationContext &context, ForceRule rule)
{
  return std::make_unique<FusedStep>(context, rule);
}

} // namespace gestell::coupling
