#include "coupling/integration/step/implicit_step.h"

#include "coupling/integration/step/condensed_matrix.h"
#include "coupling/integration/step/directions.h"
#include "coupling/integration/step/law_values.h"
#include "coupling/integration/step/rounding_floors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace gestell::coupling
{

namespace
{
constexpr double rounding       = 8. * std::numeric_limits<double>::epsilon(); ///< of sums of a few terms
constexpr double joint_rounding = 8.;   ///< times that of one number: several terms, amplified by levers
constexpr double most_left      = 1e-7; ///< of the excursion of a measure, however large the local error is
} // namespace

void fail_singular(const SecondOrderSystem &system, double t)
{
  std::ostringstream message;
  message << "the equations of the forces are singular at t = " << t << " s";
  const char *separator = ": sticking elements constrain the same DOFs: ";
  for (const HeldMeasure &h : system.forces().held())
    for (Eigen::SparseMatrix<double>::InnerIterator it(system.forces().directions(), h.measure); it; ++it)
    {
      message << separator << system.linear().coordinate_name(static_cast<int>(it.row()));
      separator = ", ";
    }
  if (!system.forces().held().empty())
    message << "; use regularised friction for one of them, or put a spring between them";
  throw ConvergenceFailure(message.str());
}

void fail_dependent(const SecondOrderSystem &system, int row, double t)
{
  std::ostringstream message;
  message << "the joints do not constrain the mechanism at t = " << t << " s: " << system.joints().name(row)
          << " is redundant here, as in a stretched linkage; change the position, or make this joint compliant";
  throw ConvergenceFailure(message.str());
}

namespace
{
/// Whether W acts only on the coordinates N.
bool leads(const std::vector<int> &N, const Eigen::SparseMatrix<double> &W)
{
  std::vector<char> is_in_N(W.rows(), 0);
  for (const int i : N)
    is_in_N[i] = 1;
  for (int j = 0; j < W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
      if (!is_in_N[it.row()])
        return false;
  return !N.empty();
}
} // namespace

ImplicitStep::ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options)
    : system_(system), options_(options), force_blocks_(system.forces().blocks()), G_(system.joints().blocks()),
      most_left_(most_left)
{
  // An error of positions causes an error of multipliers larger by the factor m/h^2.
  if (G_.n_rows() > 0)
  {
    // of the tolerance: multipliers are wrong by m / h^2 times what positions are
    constexpr double share_of_joints = 1e-3;
    options_.tolerance               = std::max(share_of_joints * options_.tolerance, finest_tolerance);
    options_.share_of_error *= share_of_joints;
    most_left_ *= share_of_joints;
    // Friction by multipliers lags one iteration behind them, with little effect on the motion.
    turn_counts_ = !system.forces().need_multipliers();
    if (!turn_counts_)
      options_.share_of_error = 0.;
  }
  const int n_u = static_cast<int>(system.forces().directions().cols());
  for (Eigen::VectorXd *of_measures :
       {&xi_, &xi_free_, &residual_, &correction_, &first_correction_, &u_begin_, &scale_, &scale_before_})
    of_measures->setZero(n_u);
  g_.setZero(G_.n_rows());
  begin(u_begin_);
  tangent_.setZero(tangent_size(force_blocks_));
  saddle_ = SaddleMatrix::for_joints(system, options.joints);
  if (saddle_)
    y_.setZero(saddle_->size());
  else
  {
    loaded_ = std::make_shared<const LoadedCoordinates>(system.forces().directions());
    matrix_ = std::make_unique<CondensedMatrix>(system, *loaded_);
  }
}

ImplicitStep::~ImplicitStep() = default;

void ImplicitStep::begin(const Eigen::VectorXd &u)
{
  u_begin_ = u;
  scale_.setZero();
  levers_age_ = 0;
  forget_contraction();
}

void ImplicitStep::forget_contraction()
{
  contraction_ = seen_ = seen_size_ = unseen_contraction;
  unseen_                           = 0;
}

/// Resets the contraction for another form: longer steps converge more slowly, and predictions err differently.
void ImplicitStep::note_form(const StepForm &form)
{
  if (form.time == form_time_)
    return;
  if (form.time > form_time_)
    contraction_ = unseen_contraction;
  form_time_ = form.time;
  seen_ = seen_size_ = unseen_contraction;
}

const ImplicitStep::Condensed &ImplicitStep::condensed(const StepForm &form, IntegrationWork &work)
{
  const std::array<double, 4> key{form.w_M, form.w_B, form.w_C, form.force};
  const auto                  found = cache_.find(key);
  if (found != cache_.end())
    return found->second;

  Condensed made;
  made.form = form;
  if (saddle_)
    return cache_.emplace(key, std::move(made)).first->second;
  made.solver = system_.linear().factorise(form.w_M, form.w_B, form.w_C);
  ++work.factorisations;
  const auto &W = system_.forces().directions();
  made.Y.resize(W.rows(), loaded_->size());
  Eigen::VectorXd x(W.rows());
  for (int i = 0; i < loaded_->size(); ++i)
  {
    made.solver->solve(form.force * loaded_->unit_force(i), x);
    made.Y.col(i) = x;
    ++work.solves;
  }
  made.S = Compliance(loaded_, made.Y);
  if (leads(made.solver->leading(), W))
  {
    made.Y_led = made.Y(made.solver->leading(), Eigen::all);
    x_led_.setZero(made.Y_led.rows());
  }
  return cache_.emplace(key, std::move(made)).first->second;
}

void ImplicitStep::motion(const StepForm &form, const LocalState &base, LocalState &local) const
{
  local.u = base.u + form.w_u * xi_;
  local.v = base.v + form.w_v * xi_;
  local.a = base.a + form.w_a * xi_;
}

/// p += p' xi
void ImplicitStep::add_tangent_times(const Eigen::VectorXd &xi, Eigen::VectorXd &p) const
{
  const double *value = tangent_.data();
  for (const ForceBlock &block : force_blocks_)
    for (int j = 0; j < block.n_measures; ++j)
      for (int i = 0; i < block.n_measures; ++i)
        p[block.first_measure + i] += *value++ * xi[block.first_measure + j];
}

/// Lower bounds: the distance moved in one step, so that a motion from rest has a scale at once, and the rounding of u;
/// for joints the rounding of g = G u, of which other elements on the same bodies receive a share.  G changes so little
/// that it is evaluated once in several steps.
void ImplicitStep::grow_scale(const StepForm &form, const LocalState &local, bool of_joints_too)
{
  const double left = rounding / options_.tolerance;
  scale_            = scale_.cwiseMax((local.u - u_begin_).cwiseAbs())
               .cwiseMax(form.time * local.v.cwiseAbs())
               .cwiseMax(left * local.u.cwiseAbs());
  if (!of_joints_too || G_.n_rows() == 0 || levers_age_++ % steps_of_levers != 0)
    return;
  double of_joints = 0.;
  for (std::size_t b = 0; b < G_.blocks().size(); ++b)
  {
    const ConstraintBlock &block      = G_.blocks()[b];
    const auto             G          = static_cast<const ConstraintJacobian &>(G_)[b];
    constexpr double       weak_lever = 1e-3; // share of the largest entry of G below which a measure hardly moves g
    const double           least      = weak_lever * G.cwiseAbs().maxCoeff();
    if (least > 0.)
      of_joints = std::max(of_joints, joint_rounding * left * block.size * weak_lever / least);
    for (int k = 0; least > 0. && k < block.n_measures; ++k)
    {
      const double lever = std::max(least, G.col(k).cwiseAbs().maxCoeff());
      double      &scale = scale_[block.first_measure + k];
      scale              = std::max(scale, joint_rounding * left * block.size / lever);
    }
  }
  scale_ = scale_.cwiseMax(of_joints);
}

/// Largest correction in the scales of the measures, at most 1.
double ImplicitStep::size_of_correction() const
{
  if (correction_.size() == 0)
    return 0.;
  const auto size = correction_.cwiseAbs();
  return size.cwiseQuotient(scale_.cwiseMax(size).cwiseMax(std::numeric_limits<double>::min())).maxCoeff();
}

/// Error after a correction, from the contraction of the one before it.  Newton's corrections shrink faster the smaller
/// they are; a larger one leaves more in proportion.  After a sudden growth, and at first, the next one decides.
double ImplicitStep::remaining(int iteration, double size, double size_before)
{
  double contraction = contraction_;
  if (iteration > 0 && size_before > 0.)
  {
    contraction = contraction_ = std::clamp(size / size_before, 1e-4, 1.);
    if (good_predictions_)
    {
      seen_      = size / size_before;
      seen_size_ = size_before;
      unseen_    = 0;
    }
  }
  else if (good_predictions_ && unseen_ < most_unseen && size < sudden_growth * first_size_)
  {
    contraction = std::min(1., seen_ * std::max(1., size / seen_size_));
    ++unseen_;
  }
  if (iteration == 0)
    first_size_ = size;
  const double left = contraction < 1. ? size * contraction / (1. - contraction) : size;
  return std::min(size, left);
}

/// In the first iteration the share of the largest correction applies to all measures.
bool ImplicitStep::is_converged(int iteration, double size, double remaining) const
{
  constexpr double below_rounding = std::numeric_limits<double>::epsilon(); // of positions: what the turn leaves behind
  if (remaining <= options_.tolerance || (turn_counts_ && remaining * remaining <= below_rounding * size))
    return true;
  if (!good_predictions_ || remaining > most_left_)
    return false;
  if (iteration == 0)
    return remaining <= options_.share_of_error * size;
  const double part = remaining / size;
  for (Eigen::Index j = 0; j < correction_.size(); ++j)
    if (part * std::abs(correction_[j]) >
        std::max(options_.tolerance * scale_[j], options_.share_of_error * std::abs(first_correction_[j])))
      return false;
  return true;
}

/// A correction that grows again jumps between the branches of a law: it is shortened.
double ImplicitStep::damping_of(int iteration, double size, double size_before)
{
  return iteration > 7 && size > 0.5 * size_before ? 0.5 : 1.;
}

/// The forces of the corrected measures, to second order in the correction; xi = xi_free + S p stays exact.
void ImplicitStep::finish(const StepForm &form, const LocalState &base, LocalState &local)
{
  add_tangent_times(correction_, local.p);
  if (G_.n_rows() > 0)
    G_.set_forces(local.lambda, local.p);
  motion(form, base, local);
  contraction_ = std::max(contraction_, best_contraction);
}

/// Newton's correction of the measures and multipliers; false if its matrix is singular.
bool ImplicitStep::correct(const Condensed &condensed, const LocalState &local)
{
  residual_ = xi_free_ - xi_;
  condensed.S.add_times(local.p, residual_);
  correction_ = residual_;
  if (!matrix_->factorise(condensed.S, tangent_, system_.forces().held()))
  {
    dependent_row_   = matrix_->failed_joint();
    joints_singular_ = dependent_row_ >= 0;
    singular_        = !joints_singular_;
    return false;
  }
  matrix_->solve_in_place(condensed.S, G_, correction_, g_);
  return correction_.allFinite() && g_.allFinite();
}

bool ImplicitStep::iterate(const Condensed &condensed, const LocalState &base, LocalState &local, IntegrationWork &work)
{
  const StepForm &form        = condensed.form;
  const auto     &held        = system_.forces().held();
  const bool      joints      = G_.n_rows() > 0;
  bool            turned      = joints; // G has, since Newton's matrix got it
  double          size_before = 0.;
  bool            went_on     = false; // behind the turn
  note_form(form);
  singular_ = joints_singular_ = false;
  for (const HeldMeasure &h : held)
    xi_[h.measure] = (h.rate - base.v[h.measure]) / form.w_v;
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration)
  {
    motion(form, base, local);
    system_.forces().tangent_blocks(local, form.w_u, form.w_v, form.w_a, local.p, tangent_);
    ++work.newton;
    ++work.evaluations;
    if (joints)
    {
      system_.joints().constraints(local, g_, G_);
      G_.set_forces(local.lambda, local.p);
      g_ /= form.w_u;
    }
    if (turned)
      matrix_->set_joints(condensed.S, G_);
    turned = false;
    if (!correct(condensed, local))
      return false;

    for (const HeldMeasure &h : held) // linear in p: nothing to iterate
    {
      local.p[h.measure] += correction_[h.measure];
      correction_[h.measure] = 0.;
    }
    grow_scale(form, local, iteration == 0);
    constexpr int most_usual = 3; // iterations: Newton is done, or rounding is to be allowed for
    if (iteration >= most_usual)
    {
      const double left = rounding / options_.tolerance;
      allow_for_rounding(condensed.S, local.p, left * std::abs(form.w_u), scale_);
      allow_for_closing(system_, condensed.S, force_blocks_, tangent_, joint_rounding * left, scale_);
    }
    const double size    = size_of_correction();
    const double damping = damping_of(iteration, size, size_before);
    if (iteration == 0 && good_predictions_)
      first_correction_ = correction_;
    xi_.noalias() += damping * correction_;
    if (joints)
      local.lambda += damping * g_;
    if (std::exchange(went_on, false)) // two corrections lie between
      size_before = std::sqrt(size_before * size);
    const double left = remaining(iteration, size, size_before);
    if (damping == 1. && is_converged(iteration, size, left))
    {
      finish(form, base, local);
      if (!joints || size <= turned_little)
        return true;
      follow_turn(condensed, base, local);
      if (ends_at_turn(iteration, size, left))
        return true;
      went_on = true;
    }
    turned      = joints && (went_on ? size_of_correction() > good_contraction * size
                                     : iteration > 0 && size > good_contraction * size_before);
    size_before = size;
  }
  return false;
}

void ImplicitStep::solve(const Condensed &condensed, const Eigen::VectorXd &f, const LocalState &base,
                         Eigen::VectorXd &x, LocalState &local, IntegrationWork &work)
{
  if (saddle_)
  {
    local.t       = base.t;
    scale_before_ = scale_;
    if (iterate_sparse(condensed.form, f, base, x, local, work))
      return;
    scale_ = scale_before_;
    forget_contraction();
    saddle_->forget_pivots();
    fail_with_law(system_, local, [&] { fail(base.t); });
  }
  condensed.solver->solve(f, x);
  find_forces(condensed, base, x, local, work);
  x.noalias() += condensed.Y.lazyProduct(condensed.S.loads(local.p));
}

void ImplicitStep::solve(const Condensed &condensed, const MassLoad &load, const LocalState &base, Eigen::VectorXd &x,
                         LocalState &local, IntegrationWork &work)
{
  const auto &[h, f] = load;
  if (condensed.Y_led.size() == 0)
  {
    f_.resize(h.size());
    system_.linear().mass_times(h, f_);
    f_ += f;
    solve(condensed, f_, base, x, local, work);
    return;
  }
  condensed.solver->solve_leading(h, f, x);
  find_forces(condensed, base, x, local, work);
  const std::vector<int> &N = condensed.solver->leading();
  x_led_.noalias()          = condensed.Y_led.lazyProduct(condensed.S.loads(local.p));
  for (std::size_t i = 0; i < N.size(); ++i)
    x[N[i]] += x_led_[Eigen::Index(i)];
  condensed.solver->solve_following(h, f, x);
}

/// Computes the forces p in A x = f + W p, where x contains the result without them.
void ImplicitStep::find_forces(const Condensed &condensed, const LocalState &base, const Eigen::VectorXd &x,
                               LocalState &local, IntegrationWork &work)
{
  const auto &W = system_.forces().directions();
  ++work.solves;
  local.t = base.t;
  if (W.cols() == 0)
  {
    if (!x.allFinite()) // with elements Newton sees it
      throw ConvergenceFailure("the motion diverged at t = " + std::to_string(base.t) + " s");
    return;
  }
  take_measures(W, x, xi_free_);
  if (condensed.form.w_u != 0.)
    xi_ = (local.u - base.u) / condensed.form.w_u;
  else
    xi_ = xi_free_;
  scale_before_ = scale_;
  if (!iterate(condensed, base, local, work))
  {
    scale_ = scale_before_; // diverged iterates are not excursions
    forget_contraction();
    levers_age_ = 0;
    fail_with_law(system_, local, [&] { fail(base.t); });
  }
}

void ImplicitStep::fail(double t) const
{
  if (singular_)
    fail_singular(system_, t);
  if (joints_singular_)
    fail_dependent(system_, dependent_row_, t);
  int worst = 0;
  for (int i = 1; i < residual_.size(); ++i)
    if (std::abs(residual_[i]) * scale_[worst] > std::abs(residual_[worst]) * scale_[i])
      worst = i;
  std::string coordinate = "?";
  for (Eigen::SparseMatrix<double>::InnerIterator it(system_.forces().directions(), worst); it; ++it)
    coordinate = system_.linear().coordinate_name(static_cast<int>(it.row()));
  std::ostringstream message;
  message << "Newton's method did not converge at t = " << t << " s in " << options_.max_iterations
          << " iterations; the largest residual is " << std::abs(residual_[worst]) << " (m or rad) at the force on "
          << coordinate;
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling
