#include "coupling/integration/step/implicit_step.h"

#include "coupling/integration/step/directions.h"

#include <cmath>
#include <utility>

namespace gestell::coupling
{

// Steps of systems with many joints: see ImplicitStep and SaddleMatrix for the equations.

bool ImplicitStep::factorise_sparse(IntegrationWork &work)
{
  ++work.factorisations;
  if (saddle_->factorise(tangent_, G_))
    return true;
  const int row    = saddle_->failed() - saddle_->n_motion();
  joints_singular_ = row >= 0 && row < G_.n_rows();
  dependent_row_   = row;
  singular_        = !joints_singular_;
  return false;
}

/// W^T x; for sticking measures the value from their rates.
void ImplicitStep::find_measures(const Eigen::VectorXd &x, const StepForm &form, const LocalState &base)
{
  take_measures(system_.forces().directions(), x, xi_);
  for (const HeldMeasure &h : system_.forces().held())
    xi_[h.measure] = (h.rate - base.v[h.measure]) / form.w_v;
}

/// Newton's correction y of x, the multipliers and the forces of sticking measures, which are linear.
bool ImplicitStep::correct_sparse(const StepForm &form, const Eigen::VectorXd &f, const Eigen::VectorXd &x,
                                  LocalState &local)
{
  const auto &W    = system_.forces().directions();
  const auto &held = system_.forces().held();
  const auto  n = x.size(), n_c = Eigen::Index(G_.n_rows());
  y_.head(n) = f;
  add_forces(W, form.force, local.p, y_);
  y_.head(n).noalias() -= saddle_->A() * x;
  y_.segment(n, n_c) = g_ / -form.w_u;
  for (std::size_t h = 0; h < held.size(); ++h)
    y_[n + n_c + Eigen::Index(h)] = xi_[held[h].measure] - W.col(held[h].measure).dot(x);
  saddle_->solve_in_place(y_);
  take_measures(W, y_, correction_);
  if (!y_.allFinite())
    return false;
  residual_ = correction_; // of the measures, for messages
  for (std::size_t h = 0; h < held.size(); ++h)
  {
    local.p[held[h].measure] += y_[n + n_c + Eigen::Index(h)] / form.force;
    correction_[held[h].measure] = 0.;
  }
  return true;
}

bool ImplicitStep::iterate_sparse(const StepForm &form, const Eigen::VectorXd &f, const LocalState &base,
                                  Eigen::VectorXd &x, LocalState &local, IntegrationWork &work)
{
  const auto n = x.size(), n_c = Eigen::Index(G_.n_rows());
  double     size_before = 0.;
  bool       went_on     = false; // behind the turn
  singular_ = joints_singular_ = false;
  note_form(form);
  saddle_->hold(system_.forces().held());
  saddle_->set_weights(form.w_M, form.w_B, form.w_C, form.force);
  y_.resize(saddle_->size());
  saddle_->forget_factor(); // the old one costs more iterations than it saves

  find_measures(x, form, base);
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration)
  {
    motion(form, base, local);
    system_.forces().tangent_blocks(local, form.w_u, form.w_v, form.w_a, local.p, tangent_);
    system_.joints().constraints(local, g_, G_);
    G_.set_forces(local.lambda, local.p);
    ++work.newton;
    ++work.evaluations;
    if (!saddle_->has_factor() && !factorise_sparse(work))
      return false;

    ++work.solves;
    if (!correct_sparse(form, f, x, local))
      return false;
    grow_scale(form, local, true);
    const double size    = size_of_correction();
    const double damping = damping_of(iteration, size, size_before);
    if (iteration == 0 && good_predictions_)
      first_correction_ = correction_;
    x += damping * y_.head(n);
    local.lambda += (damping / form.force) * y_.segment(n, n_c);
    xi_ += damping * correction_;
    if (std::exchange(went_on, false)) // two corrections lie between
      size_before = std::sqrt(size_before * size);
    const double left = remaining(iteration, size, size_before);
    // Friction by multipliers converges linearly, as slowly as rounding seems to.
    const bool only_rounding = turn_counts_ && iteration > 0 && size <= most_left_ && size >= 0.5 * size_before;
    if (damping == 1. && (only_rounding || is_converged(iteration, size, left)))
    {
      if (size <= turned_little)
      {
        finish(form, base, local);
        return true;
      }
      motion(form, base, local);
      if (!follow_turn_sparse(form, f, base, x, local))
        return false;
      if (ends_at_turn(iteration, size, left))
        return true;
      went_on = true;
    }
    if (went_on ? size_of_correction() > good_contraction * size
                : iteration > 0 && size > good_contraction * size_before)
      saddle_->forget_factor();
    size_before = size;
  }
  return false;
}

} // namespace gestell::coupling
