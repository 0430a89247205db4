#include "coupling/integration/bdf/bdf_controlled.h"

#include <algorithm>
#include <cmath>
#include <sstream>

// Trial steps, and the choice of the next step from their errors.

namespace gestell::coupling
{

namespace
{
constexpr int    highest_growth = 3;   ///< levels at once: eight times the step
constexpr double safety         = 0.3; ///< of the tolerance, that an error expected may reach: few steps are refused

} // namespace

void BdfControlled::advance()
{
  if (cut_)
    restart();
  const double t = t_end_;
  z_begin_       = z_;
  try
  {
    if (fresh_)
      start();
    else
      multistep();
  }
  catch (const ConvergenceFailure &)
  {
    z_       = z_begin_;
    t_begin_ = t_end_ = t;
    present(z_, t);
    fresh_ = true;
    throw;
  }
  ++work_.steps;
  present(z_, t_end_);
}

/// Diverged iterates have increased the excursions that scale Newton's tolerance; the old excursions are restored.
void BdfControlled::newton_failed(const ConvergenceFailure &failure)
{
  reason_       = failure.what();
  reason_id_    = failure.id();
  reason_place_ = failure.place();
  implicit_.begin(z_begin_.segment(2 * n_, n_u_));
}

BdfControlled::Trial BdfControlled::try_multistep(double h)
{
  Trial        trial;
  const double t = anchor_ + static_cast<double>(steps_ + 1) * h;
  differences_.predict(order_, predicted_, history_);
  local_.u      = predicted_.segment(2 * n_, n_u_);
  local_.p      = predicted_.segment(2 * n_ + 3 * n_u_, n_u_);
  local_.lambda = predicted_.tail(n_c_);
  try
  {
    implicit_step(t, h / bdf_gamma(order_), history_, z_);
  }
  catch (const ConvergenceFailure &failure)
  {
    newton_failed(failure);
    return trial;
  }
  if (!scale_.consider(t, h, motion(z_begin_), motion(z_), moved_))
    return trial;
  difference_  = z_ - predicted_;
  trial.solved = true;
  trial.h_beta = h / bdf_gamma(order_);
  trial.error  = error_of(difference_) / (bdf_gamma(order_) * (order_ + 1) * options_.tolerance);
  return trial;
}

void BdfControlled::multistep()
{
  change(wanted_rung_, wanted_order_);
  for (int refusals = 0;;)
  {
    const double h     = step_of(rung_);
    const Trial  trial = try_multistep(h);
    if (trial.solved && trial.error <= 1.)
    {
      t_begin_ = t_end_;
      t_end_   = anchor_ + static_cast<double>(++steps_) * h;
      break;
    }
    ++work_.rejected;
    z_ = z_begin_;
    refuse(trial, order_);
    if (++refusals == 2 && !options_.fixed_order)
      wanted_order_ = std::min(wanted_order_, std::max(2, options_.min_order));
    if (refusals == 3)
    {
      rung_ = wanted_rung_;
      start();
      return;
    }
    change(wanted_rung_, wanted_order_);
  }
  scale_.accept();
  if (finds_held() || (n_c_ > 0 && system_.joints().wants_multipliers()))
  {
    find_implied(z_, t_end_);
    difference_.tail(2 * n_u_ + n_c_) = z_.tail(2 * n_u_ + n_c_) - predicted_.tail(2 * n_u_ + n_c_);
  }
  // With a phase of pi per step or more, the values of a harmonic load at the ends of steps do not determine it inside.
  lambda_size_                = lambda_size_.cwiseMax(z_.tail(n_c_).cwiseAbs());
  constexpr double unforeseen = 1e-4; // of a multiplier's largest: inside the step polynomials miss a tenth of it
  solves_inside_              = fastest_load_ * step_of(rung_) > 1. ||
                   (difference_.tail(n_c_).cwiseAbs().array() > unforeseen * lambda_size_.array()).any();
  differences_.push(order_, difference_);
  ++since_change_;
  barred_  = std::max(0, barred_ - 1);
  started_ = false;
  choose();
}

/// After a rejected step: reduction of the next step, and its order.  The error is proportional to h^exponent.
void BdfControlled::refuse(const Trial &trial, double exponent)
{
  int rungs = 1;
  if (trial.solved && is_sound(trial.h_beta))
    scale_.refuse();
  constexpr int deepest_fall = 6; // levels at once, in a start: a 64th of the step
  if (trial.solved)
    rungs = std::clamp(static_cast<int>(std::ceil(std::log2(trial.error / safety) / exponent)), 1,
                       fresh_ ? deepest_fall : highest_growth);
  if (step_of(rung_ + rungs) < options_.smallest_step)
    fail(step_of(rung_), trial);
  wanted_rung_  = rung_ + rungs;
  wanted_order_ = order_;
  if (order_ > 2 && !options_.fixed_order)
  {
    constexpr int steps_barred = 40; // enough for differences of the order to forget what refused it
    barred_                    = since_change_ == 0 ? steps_barred : 0; // refused again at once: order 2 for a while
    wanted_order_              = std::max(order_ - 1, options_.min_order);
    while (wanted_order_ > options_.min_order && !limit_.allows(wanted_order_, wanted_rung_))
      --wanted_order_;
  }
}

/// Error of the last step, had it been of this order.
double BdfControlled::error_of_order(int order) const
{
  return error_of(differences_[order + 1]) / (bdf_gamma(order) * (order + 1) * options_.tolerance);
}

/// Number of levels by which a step of this order may grow, for an error with the margin `gain`; -1: the order must not
/// be used.
int BdfControlled::growth(int order, double gain)
{
  int rungs = std::min({highest_growth, rung_, std::max(0, std::ilogb(gain))});
  while (rungs >= 0 && !options_.fixed_order && !limit_.allows(order, rung_ - rungs))
    --rungs;
  return order == order_ ? std::max(rungs, 0) : rungs;
}

/// Chooses order and length of the next step, after enough steps of this length.
void BdfControlled::choose()
{
  wanted_rung_  = rung_;
  wanted_order_ = order_;
  if (since_change_ == 0 || since_change_ % (order_ + 1) != 0)
    return;
  if (order_ < options_.min_order)
  {
    wanted_order_ = order_ + 1;
    return;
  }
  double best = 0., gain_here = 0.;
  // Order 2 is always included: it remains if a higher order is not allowed with longer steps.
  for (const int order : {order_, order_ - 1, order_ + 1, order_ > 3 ? 2 : 0})
  {
    if (order < options_.min_order || order > options_.max_order || order + 1 > differences_.known() || order == 0 ||
        (order > std::max(2, order_) && barred_ > 0))
      continue;
    const double error = error_of_order(order);
    const double gain  = std::min(std::pow(safety / std::max(error, 1e-30), 1. / order), 1e3);
    const int    rungs = growth(order, gain);
    if (rungs < 0)
      continue;
    // Among steps on the same level the present order is kept, unless another one has a larger margin.
    double           worth          = std::ldexp(1., rungs);
    constexpr double worth_an_order = 1.3; // factor of the step expected, for which the order is raised
    if (order == order_)
      gain_here = gain;
    else if (rung_ - rungs > 0 && gain > worth_an_order * gain_here && gain > 1. && std::abs(order - order_) == 1)
      worth *= 1.1;
    else
      worth *= 0.9;
    if (worth > best)
    {
      best          = worth;
      wanted_order_ = order;
      wanted_rung_  = rung_ - rungs;
    }
  }
}

void BdfControlled::change(int rung, int order)
{
  if (rung == rung_ && order == order_)
    return;
  if (rung != rung_)
  {
    differences_.rescale(std::ldexp(1., rung_ - rung), std::min(differences_.known(), order + 1));
    anchor_ = t_end_;
    steps_  = 0;
  }
  rung_         = rung;
  order_        = order;
  since_change_ = 0;
}

/// If a force decreases with the motion (dp/du > 0), the equation of a step has a pole, I - S dp singular, and near it
/// and beyond it spurious solutions.  If all pivots of I - S dp at the start of the step are above a quarter, the
/// solution is at most about four times as large as it should be.
bool BdfControlled::is_sound(double h_beta)
{
  const double   inverse = 1. / h_beta, squared = h_beta * h_beta;
  const StepForm form{1., h_beta, squared, squared, 1., inverse, inverse * inverse, h_beta};
  const auto    &S = implicit_.condensed(form, work_).S.matrix();
  dp_du_.setZero(); // sticking measures write nothing
  dp_dv_.setZero();
  point(z_begin_, t_end_, local_);
  system_.forces().derivatives(local_, base_.p, dp_du_, dp_dv_);
  ++work_.evaluations;
  scale_.laws(dp_du_, dp_dv_);
  pivots_.noalias() = -S.lazyProduct(dp_du_);
  pivots_.noalias() -= inverse * S.lazyProduct(dp_dv_);
  pivots_.diagonal().array() += 1.;
  for (Eigen::Index k = 0; k < n_u_; ++k)
  {
    if (!(pivots_(k, k) > 0.25))
      return false;
    for (Eigen::Index i = k + 1; i < n_u_; ++i)
      pivots_.row(i) -= pivots_(i, k) / pivots_(k, k) * pivots_.row(k);
  }
  return true;
}

/// n implicit Euler steps over the length, from z_begin_: where they are after half of it, and at the end.
void BdfControlled::euler_chain(double length, int n, Eigen::VectorXd &middle, Eigen::VectorXd &end)
{
  const double h = length / n;
  point(z_begin_, t_end_, local_);
  const Eigen::VectorXd *from = &z_begin_;
  for (int i = 1; i <= n; ++i)
  {
    Eigen::VectorXd &to = i == n ? end : 2 * i == n ? middle : chain_[i % 2];
    local_.u            = from->segment(2 * n_, n_u_) + h * from->segment(2 * n_ + n_u_, n_u_);
    implicit_step(t_end_ + i * h, h, *from, to);
    from = &to;
  }
}

BdfControlled::Trial BdfControlled::try_start(double h)
{
  Trial        trial;
  const double length = 2. * h;
  try
  {
    for (int i = 0; i < 3; ++i)
      euler_chain(length, 1 << i, middle_[i], end_[i]);
  }
  catch (const ConvergenceFailure &failure)
  {
    newton_failed(failure);
    return trial;
  }
  // Euler's error is a power series in the step: weights 2 and 4 remove its first and second power.
  middle_[2]  = 2. * middle_[2] - middle_[1];
  end_[0]     = 2. * end_[1] - end_[0];
  end_[1]     = 2. * end_[2] - end_[1];
  difference_ = (end_[1] - end_[0]) / 3.;
  end_[2]     = end_[1] + difference_;
  moved_ *= 16.; // in the step of the first chain, four times as long as the last one
  if (!scale_.consider(t_end_ + length, length, motion(z_begin_), motion(end_[2]), moved_))
    return trial;
  trial.solved = true;
  trial.h_beta = length; // of the first chain
  trial.error  = error_of(difference_) / options_.tolerance;
  return trial;
}

/// A stiffness that appears at an event (a contact closes) may be far above all before.  Implicit Euler steps that do
/// not resolve it would damp its motion, and all chains equally, so that their difference does not show it.  With S,
/// the compliance over a step, S dp/du = (omega h)^2.
void BdfControlled::resolve_stiffness()
{
  for (;;)
  {
    const double h = step_of(rung_ + 1), squared = h * h;
    if (stiffness_.size() == 0 || stiffness_.maxCoeff() == 0. || h < options_.smallest_step)
      break;
    const StepForm form{1., h, squared, squared, 1., 1. / h, 1. / squared, h};
    const double   most = implicit_.condensed(form, work_).S.matrix().diagonal().cwiseProduct(stiffness_).maxCoeff();
    // omega h of a start's shortest Euler step, which errs by its square over two, 1/8
    constexpr double resolved = 0.5;
    if (!(most > resolved * resolved))
      break;
    rung_ += std::max(1, static_cast<int>(std::ceil(std::log2(std::sqrt(most) / resolved))));
    while (rung_ > 1 && step_of(rung_) < options_.smallest_step)
      --rung_;
  }
  stiffness_.setZero();
}

/// Takes half of the displacement of a start from the velocities, which are known to second order there: one order
/// better than the extrapolation of two chains, and after a break-away (q ~ t^3) the first correct value.
void BdfControlled::improve_middle()
{
  const double part   = 2. * step_of(rung_) / 24.;
  const auto   better = [&](Eigen::Index value, Eigen::Index slope, Eigen::Index size)
  {
    middle_[2].segment(value, size) =
        z_begin_.segment(value, size) +
        part * (5. * z_begin_.segment(slope, size) + 8. * middle_[2].segment(slope, size) - z_.segment(slope, size));
  };
  better(0, n_, n_);
  better(2 * n_, 2 * n_ + n_u_, n_u_);
}

void BdfControlled::start()
{
  fresh_ = true;
  order_ = std::min(2, options_.max_order);
  rung_  = std::max(rung_, 1); // a start is two steps long
  resolve_stiffness();
  for (;;)
  {
    const Trial trial = try_start(step_of(rung_));
    if (trial.solved && trial.error <= 1.)
      break;
    ++work_.rejected;
    z_ = z_begin_;
    refuse(trial, 2.);
    rung_ = wanted_rung_;
  }
  scale_.accept();
  z_ = end_[2];
  improve_middle();
  if (is_implied())
  {
    find_implied(middle_[2], t_end_ + step_of(rung_));
    find_implied(z_, t_end_ + 2. * step_of(rung_));
  }
  // u'' and p at the start may be those of another branch: they follow from the motion, or are extrapolated backwards.
  chain_[0] = z_begin_;
  if (is_implied() && has_consistent())
    find_implied(chain_[0], t_end_);
  else
    chain_[0].tail(2 * n_u_ + n_c_) = 2. * middle_[2].tail(2 * n_u_ + n_c_) - z_.tail(2 * n_u_ + n_c_);
  differences_.start(chain_[0], middle_[2], z_);
  anchor_        = t_end_;
  steps_         = 2;
  t_begin_       = t_end_;
  t_end_         = anchor_ + 2. * step_of(rung_);
  wanted_rung_   = rung_;
  wanted_order_  = order_;
  since_change_  = 1;
  fresh_         = false;
  started_       = true;
  solves_inside_ = n_c_ > 0;
}

void BdfControlled::fail(double h, const Trial &trial) const
{
  std::ostringstream message;
  message << "BDF with controlled step: at t = " << t_end_ << " s the step of " << h
          << " s would have to be smaller than the smallest step, " << options_.smallest_step << " s; ";
  if (trial.solved)
    message << "the local error of order " << order_ << " is still " << trial.error << " times the tolerance "
            << options_.tolerance << ", and largest in " << scale_.worst(motion(difference_))
            << ". Does a force jump there without an event? Locate events, smooth the force, or allow a larger "
               "tolerance or a smaller step";
  else if (!reason_.empty())
    message << reason_ << ". Check the force there, or allow a smaller step";
  else
    message << "the motion is no longer finite";
  throw trial.solved ? ConvergenceFailure(message.str()) : ConvergenceFailure(message.str(), reason_id_, reason_place_);
}

} // namespace gestell::coupling
