#include "coupling/integration/step/condensed_matrix.h"
#include "coupling/integration/step/implicit_step.h"

namespace gestell::coupling
{

// Newton's last correction moves constrained points along directions that it rotates itself.  The remaining error is of
// second order, but the same in every step: as large as rounding in positions it is 1e-8 of forces and, after a few
// hundred steps, of velocities.  Which correction is the last one depends on the axes of the bodies.  Therefore forces
// and joints are evaluated once more, and the residual is removed with the existing factors.

/// The forces of elements, but not of what sticks, and of joints, where they are now.
void ImplicitStep::take_forces(LocalState &local)
{
  residual_ = local.p;
  system_.forces().force(local, local.p);
  for (const HeldMeasure &h : system_.forces().held())
    local.p[h.measure] = residual_[h.measure];
  system_.joints().constraints(local, g_, G_);
  G_.set_forces(local.lambda, local.p);
}

void ImplicitStep::follow_turn(const Condensed &condensed, const LocalState &base, LocalState &local)
{
  take_forces(local);
  g_ /= condensed.form.w_u;
  correction_ = xi_free_ - xi_;
  condensed.S.add_times(local.p, correction_);
  matrix_->solve_in_place(condensed.S, G_, correction_, g_);
  for (const HeldMeasure &h : system_.forces().held())
  {
    local.p[h.measure] += correction_[h.measure];
    correction_[h.measure] = 0.;
  }
  xi_ += correction_;
  local.lambda += g_;
  finish(condensed.form, base, local);
}

bool ImplicitStep::follow_turn_sparse(const StepForm &form, const Eigen::VectorXd &f, const LocalState &base,
                                      Eigen::VectorXd &x, LocalState &local)
{
  take_forces(local);
  if (!correct_sparse(form, f, x, local))
    return false;
  const auto n = x.size(), n_c = Eigen::Index(G_.n_rows());
  x += y_.head(n);
  local.lambda += y_.segment(n, n_c) / form.force;
  xi_ += correction_;
  finish(form, base, local);
  return true;
}

/// Whether the turn, now in correction_, is as small as it was expected to be after a first correction of that size. As
/// small as rounding it measures the contraction only if that is stronger than known.
bool ImplicitStep::ends_at_turn(int iteration, double size, double expected)
{
  const double turn = size_of_correction();
  if (iteration > 0 || !turn_counts_)
    return true;
  if (good_predictions_ && (turn > turned_little || turn < seen_ * size))
  {
    seen_      = turn / size;
    seen_size_ = size;
    unseen_    = 0;
  }
  return expected <= options_.tolerance || turn <= turned_little || is_converged(0, size, turn);
}

} // namespace gestell::coupling
