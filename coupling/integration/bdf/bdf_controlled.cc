#include "coupling/integration/bdf/bdf_controlled.h"
#include "coupling/integration/system/fastest_load.h"

#include "coupling/integration/system/acceleration_forces.h"
#include "coupling/integration/system/hermite.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
template <typename Value>
void require(bool valid, const char *option, Value value, const char *needed)
{
  if (valid)
    return;
  std::ostringstream message;
  message << "BDF with controlled step: " << option << " is " << value << "; it must be " << needed;
  throw std::invalid_argument(message.str());
}

BdfControlled::Options checked(BdfControlled::Options           o, const SecondOrderSystem &,
                               const std::vector<SpectrumLine> &spectrum)
{
  require(o.tolerance >= 1e-13 && o.tolerance <= 0.1, "tolerance", o.tolerance, "between 1e-13 and 0.1");
  require(o.max_order >= 1 && o.max_order <= 6, "max_order", o.max_order, "1 to 6");
  require(o.min_order >= 0 && o.min_order <= o.max_order, "min_order", o.min_order, "1 to max_order, or 0");
  if (o.min_order == 0)
    o.min_order = std::min(2, o.max_order);
  if (const double omega = slowest_elastic(spectrum); o.largest_step == 0. && std::isfinite(omega))
    o.largest_step = 1. / omega;
  require(o.largest_step > 0. && std::isfinite(o.largest_step), "largest_step [s]", o.largest_step, "positive");
  constexpr int rungs_below = 40; // levels below the largest step, if no smallest step is given: 1e-12 of the largest
  if (o.smallest_step == 0.)
    o.smallest_step = std::ldexp(o.largest_step, -rungs_below);
  constexpr int most_rungs_below = 60; // 2^-60 is below the rounding of a time
  require(o.smallest_step <= o.largest_step && o.smallest_step >= std::ldexp(o.largest_step, -most_rungs_below),
          "smallest_step [s]", o.smallest_step, "between 2^-60 and 1 of the largest one");
  o.newton.joints                = JointSolver::condensed; // its S is used
  constexpr double newton_part   = 1e-2;  // of the tolerance: errors of Newton are small compared with those of steps
  constexpr double finest_newton = 1e-12; // rounding of residuals
  o.newton.tolerance             = std::max(newton_part * o.tolerance, finest_newton);
  if (o.fixed_order)
    o.min_order = o.max_order;
  return o;
}
} // namespace

BdfControlled::BdfControlled(const SecondOrderSystem &system, const Options &options)
    : BdfControlled(system, options, system.linear().spectrum())
{
}

BdfControlled::BdfControlled(const SecondOrderSystem &system, const Options &options,
                             const std::vector<SpectrumLine> &spectrum)
    : system_(system), options_(checked(options, system, spectrum)), scale_(system, spectrum, options_.tolerance),
      limit_(spectrum, system.linear().size() - scale_.massless(), options_.largest_step),
      implicit_(system, options_.newton), virtual_rates_(system), n_(system.linear().size()),
      n_u_(system.forces().directions().cols()), n_c_(system.joints().n_rows())
{
  const Eigen::Index size = 2 * n_ + 4 * n_u_ + n_c_;
  differences_.resize(size);
  for (Eigen::VectorXd *x : {&z_begin_, &z_cut_, &z_, &predicted_, &difference_, &history_, &chain_[0], &chain_[1],
                             &middle_[0], &middle_[1], &middle_[2], &end_[0], &end_[1], &end_[2]})
    x->setZero(size);
  for (Eigen::VectorXd *x :
       {&f_t_, &f_, &h_q_, &h_v_, &x_, &product_, &now_.q, &now_.v, &q_inside_, &v_inside_, &a_inside_, &no_v_})
    x->setZero(n_);
  no_rate_.setZero(n_u_);
  lambda_size_.setZero(n_c_);
  fastest_load_ = fastest_load(system.linear().excitation());
  dp_du_.setZero(n_u_, n_u_);
  pivots_.setZero(n_u_, n_u_);
  dp_dv_.setZero(n_u_, n_u_);
  stiffness_.setZero(n_u_);
  moved_.setZero(n_u_);
  for (LocalState *state : {&local_, &base_, &now_.local})
    state->resize(system_);
}

double BdfControlled::step_of(int rung) const
{
  return std::ldexp(options_.largest_step, -rung);
}

ErrorScale::Motion BdfControlled::motion(const Eigen::VectorXd &z) const
{
  return {z.head(n_), z.segment(n_, n_), z.segment(2 * n_, n_u_), z.segment(2 * n_ + n_u_, n_u_)};
}

void BdfControlled::point(const Eigen::VectorXd &z, double t, LocalState &state) const
{
  state.t      = t;
  state.u      = z.segment(2 * n_, n_u_);
  state.v      = z.segment(2 * n_ + n_u_, n_u_);
  state.a      = z.segment(2 * n_ + 2 * n_u_, n_u_);
  state.p      = z.segment(2 * n_ + 3 * n_u_, n_u_);
  state.lambda = z.tail(n_c_);
}

void BdfControlled::present(const Eigen::VectorXd &z, double t)
{
  point(z, t, local_);
  now_known_ = false;
}

const Instant &BdfControlled::instant() const
{
  if (!now_known_)
  {
    const Eigen::VectorXd &z = cut_ ? z_cut_ : z_;
    now_.t                   = local_.t;
    now_.q                   = z.head(n_);
    now_.v                   = z.segment(n_, n_);
    now_.local               = local_;
    now_known_               = true;
  }
  return now_;
}

void BdfControlled::load(double t)
{
  const Excitation &excitation = system_.linear().excitation();
  if (load_known_ && excitation.is_constant())
    return;
  excitation.at(t, f_t_);
  load_known_ = true;
}

void BdfControlled::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const auto &W = system_.forces().directions();
  z_.setZero();
  z_.head(n_)                     = q;
  z_.segment(n_, n_)              = v;
  z_.segment(2 * n_, n_u_)        = W.transpose() * q;
  z_.segment(2 * n_ + n_u_, n_u_) = W.transpose() * v;
  scale_.begin(motion(z_));
  implicit_.begin(z_.segment(2 * n_, n_u_));
  load_known_              = false;
  cut_                     = false;
  barred_                  = 0;
  constexpr int first_rung = 5; // first level at the start of a run: 1/32 of the largest step
  rung_                    = first_rung;
  while (rung_ > 1 && step_of(rung_) < options_.smallest_step)
    --rung_;
  present(z_, t);
  stiffness_.setZero();
  restart();
}

void BdfControlled::restart()
{
  if (cut_)
    z_ = z_cut_;
  cut_     = false;
  fresh_   = true;
  t_begin_ = t_end_ = local_.t;
  implicit_.forget_contraction();
  system_.forces().force(local_, local_.p);
  ++work_.evaluations;
  bool follow = is_implied();
  if (!follow)
  {
    ++work_.evaluations;
    follow = depend_on_accelerations(system_, local_);
  }
  if (follow && has_consistent())
    close_joints(); // also for the accelerations on which forces depend
  virtual_rates_.settle(z_.head(n_), z_.segment(n_, n_), local_);
  z_.segment(2 * n_ + n_u_, n_u_) = local_.v;
  keep_forces(z_);
  now_known_ = false;
  system_.forces().derivatives(local_, base_.p, dp_du_, dp_dv_);
  ++work_.evaluations;
  scale_.laws(dp_du_, dp_dv_);
  scale_.inertia(local_);
  stiffness_ = (dp_du_.diagonal() - stiffness_).cwiseAbs();
}

bool BdfControlled::is_implied() const
{
  return n_c_ > 0 || !system_.forces().held().empty();
}

/// With a singular M there is no acceleration, and the first step determines the forces.
bool BdfControlled::has_consistent()
{
  if (!consistent_ && !massless_)
    try
    {
      consistent_ = std::make_unique<ConsistentStart>(system_, "BDF with controlled step", options_.newton.joints);
    }
    catch (const std::invalid_argument &)
    {
      massless_ = true;
    }
  return consistent_ != nullptr;
}

/// Whether a measure sticks, and the equation of motion gives its force.
bool BdfControlled::finds_held() const
{
  return consistent_ && !system_.forces().held().empty();
}

/// Forces of sticking measures and joints at an instant follow from the equation of motion, not from a law.
void BdfControlled::find_implied(Eigen::VectorXd &z, double t)
{
  if (!has_consistent())
    return;
  present(z, t);
  h_q_ = z.head(n_);
  h_v_ = z.segment(n_, n_);
  if (n_c_ > 0)
    consistent_->solve(h_q_, h_v_, product_, local_, work_);
  else
    consistent_->hold(h_q_, h_v_, local_, work_);
  keep_forces(z);
}

/// Stores u'', p and lambda of the present instant.
void BdfControlled::keep_forces(Eigen::VectorXd &z) const
{
  z.segment(2 * n_ + 2 * n_u_, n_u_) = local_.a;
  z.segment(2 * n_ + 3 * n_u_, n_u_) = local_.p;
  z.tail(n_c_)                       = local_.lambda;
}

/// Projects z_ and the present instant onto g = 0, g' = 0, and computes the forces there.
void BdfControlled::close_joints()
{
  h_q_ = z_.head(n_);
  h_v_ = z_.segment(n_, n_);
  consistent_->project(h_q_, h_v_, local_);
  z_.head(n_)                     = h_q_;
  z_.segment(n_, n_)              = h_v_;
  z_.segment(2 * n_, n_u_)        = local_.u;
  z_.segment(2 * n_ + n_u_, n_u_) = local_.v;
  consistent_->solve(h_q_, h_v_, product_, local_, work_);
}

/// Error in the norm of ErrorScale.
double BdfControlled::error_of(const Eigen::Ref<const Eigen::VectorXd> &z) const
{
  if (n_c_ > 0)
    return scale_.error({z.head(n_), no_v_, z.segment(2 * n_, n_u_), no_rate_});
  return scale_.error({z.head(n_), z.segment(n_, n_), z.segment(2 * n_, n_u_), z.segment(2 * n_ + n_u_, n_u_)});
}

/// z at t from  h_b z' = z - history  for z = q, q'; local_.u, local_.p are the prediction.
void BdfControlled::implicit_step(double t, double h_beta, const Eigen::VectorXd &history, Eigen::VectorXd &z)
{
  const double inverse = 1. / h_beta, squared = h_beta * h_beta;
  load(t);
  h_v_ = history.segment(n_, n_);
  h_q_ = history.head(n_) + h_beta * h_v_;
  system_.linear().damping_times(h_v_, f_);
  system_.linear().stiffness_times(h_q_, product_);
  f_      = squared * (f_t_ - f_ - product_);
  base_.t = t;
  base_.v = history.segment(2 * n_ + n_u_, n_u_);
  base_.u = history.segment(2 * n_, n_u_) + h_beta * base_.v;
  base_.a.setZero();
  const StepForm                 form{1., h_beta, squared, squared, 1., inverse, inverse * inverse, h_beta};
  const ImplicitStep::Condensed &condensed = implicit_.condensed(form, work_);
  implicit_.solve(condensed, f_, base_, x_, local_, work_);
  const Eigen::MatrixXd &S = condensed.S.matrix();
  for (Eigen::Index j = 0; j < n_u_; ++j)
    moved_[j] = S.row(j).cwiseProduct(local_.p.transpose()).cwiseAbs().maxCoeff();
  z.head(n_)                     = h_q_ + x_;
  z.segment(n_, n_)              = h_v_ + inverse * x_;
  z.segment(2 * n_, n_u_)        = local_.u;
  z.segment(2 * n_ + n_u_, n_u_) = local_.v;
  keep_forces(z);
}

void BdfControlled::interpolate_part(double t, Eigen::Index value, Eigen::Index slope, Eigen::VectorXd &x,
                                     Eigen::VectorXd &rate) const
{
  const auto size = x.size();
  if (t_end_ == t_begin_)
  {
    x    = z_.segment(value, size);
    rate = z_.segment(slope, size);
    return;
  }
  if (order_ > 2 && !started_)
  {
    const double s = (t - t_end_) / step_of(rung_);
    differences_.at(s, order_ + 1, value, x);
    differences_.at(s, order_ + 1, slope, rate);
    return;
  }
  const double           times[]  = {t_begin_, t_end_, 0.5 * (t_begin_ + t_end_)};
  const Eigen::VectorXd *points[] = {&z_begin_, &z_, &middle_[2]};
  const int              n        = started_ ? 3 : 2;
  const auto             weights  = hermite_weights(times, n, t);
  x.setZero();
  rate.setZero();
  for (int i = 0; i < n; ++i)
  {
    x += weights.value[i] * points[i]->segment(value, size) + weights.slope[i] * points[i]->segment(slope, size);
    rate += weights.rate_value[i] * points[i]->segment(value, size) +
            weights.rate_slope[i] * points[i]->segment(slope, size);
  }
}

void BdfControlled::interpolate(double t, LocalState &state) const
{
  state.t = t;
  interpolate_part(t, 2 * n_, 2 * n_ + n_u_, state.u, state.v);
  if (t_end_ == t_begin_)
  {
    point(z_, t, state);
    return;
  }
  const double s      = (t - t_end_) / step_of(rung_);
  const int    degree = started_ ? 2 : order_ + 1;
  differences_.at(s, degree, 2 * n_ + 2 * n_u_, state.a);
  differences_.at(s, degree, 2 * n_ + 3 * n_u_, state.p);
  differences_.at(s, degree, 2 * n_ + 4 * n_u_, state.lambda);
  if (solves_inside_ && consistent_ && system_.joints().wants_multipliers())
    return solve_inside(t, state);
  if (!finds_held())
    return;
  // Interpolates values only: q'' of modes that the step does not resolve would be that of the cubic.
  differences_.at(s, degree, 0, q_inside_);
  differences_.at(s, degree, n_, v_inside_);
  consistent_->hold(q_inside_, v_inside_, state, work_);
}

/// Three instants of a start give a parabola for the forces of joints, a quintic for the motion; afterwards loads may
/// change faster than the motion, which alone controls the step.  Therefore the forces are computed from the motion.
void BdfControlled::solve_inside(double t, LocalState &state) const
{
  IntegrationWork work; // of looking, not of the step
  const double    s = (t - t_end_) / step_of(rung_);
  if (started_)
    interpolate_part(t, 0, n_, q_inside_, v_inside_);
  else
  {
    differences_.at(s, order_ + 1, 0, q_inside_);
    differences_.at(s, order_ + 1, n_, v_inside_);
  }
  inside_ = state;
  try
  {
    consistent_->solve(q_inside_, v_inside_, a_inside_, inside_, work);
    state = inside_;
  }
  catch (const ConvergenceFailure &) // the polynomial stays
  {
  }
}

void BdfControlled::interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const
{
  interpolate_part(t, 0, n_, q, v);
}

void BdfControlled::motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q,
                              Eigen::VectorXd &v) const
{
  if (t != time())
  {
    interpolate(t, q, v);
    return;
  }
  const Eigen::VectorXd &z = cut_ ? z_cut_ : z_;
  for (const int i : coordinates)
  {
    q[i] = z[i];
    v[i] = z[n_ + i];
  }
}

void BdfControlled::cut(double t)
{
  if (!(t > t_begin_)) // the cut removes the whole step
    z_cut_ = z_begin_;
  else
  {
    interpolate(t, base_);
    keep_held_rates(system_, base_.v);
    interpolate_part(t, 0, n_, x_, product_);
    z_cut_ << x_, product_, base_.u, base_.v, base_.a, base_.p, base_.lambda;
  }
  cut_ = true;
  present(z_cut_, t);
  if (is_implied() &&
      t > t_begin_) // as at the restart, so that a measure that breaks away does not stick again at once
    find_implied(z_cut_, t);
  system_.forces().derivatives(local_, base_.p, dp_du_, dp_dv_);
  ++work_.evaluations;
  stiffness_ = dp_du_.diagonal();
}

} // namespace gestell::coupling
