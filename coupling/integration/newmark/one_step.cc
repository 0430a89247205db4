#include "coupling/integration/newmark/one_step.h"
#include "coupling/integration/system/state_archive.h"

#include "coupling/integration/system/hermite.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

namespace gestell::coupling
{

namespace
{

double require_step(const std::string &name, double step)
{
  if (!(step > 0.) || !std::isfinite(step))
    throw std::invalid_argument(name + ": step " + std::to_string(step) + " s; it must be positive");
  return step;
}

} // namespace

OneStep::OneStep(const SecondOrderSystem &system, const std::string &name, double step, int max_halvings,
                 const NewtonOptions &newton)
    : system_(system), implicit_(system, newton), step_(require_step(name, step)), max_halvings_(max_halvings),
      start_(system, name, newton.joints), middle_(std::max(max_halvings, 0) + 1)
{
  if (const auto &massless = system.linear().virtual_coordinates(); !massless.empty())
    throw std::invalid_argument(name + ": the mass matrix is singular: " +
                                system.linear().coordinate_name(massless.front()) + " has no mass; use the method bdf");
  for (Point *point : {&begin_, &end_, &cut_point_})
    resize(*point);
  q_inside_.setZero(system.linear().size());
  v_inside_.setZero(system.linear().size());
}

void OneStep::resize(Point &point) const
{
  const auto n = system_.linear().size();
  for (Eigen::VectorXd *x : {&point.motion.q, &point.motion.v, &point.a, &point.f})
    x->setZero(n);
  point.motion.local.resize(system_);
  point.keep_balance();
}

/// Sets the present point to t, q, v with its measures; there is no previous step.
void OneStep::place(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const auto &W    = system_.forces().directions();
  Instant    &here = end_.motion;
  here.t = here.local.t  = t;
  here.q                 = q;
  here.v                 = v;
  here.local.u.noalias() = W.transpose() * q;
  here.local.v.noalias() = W.transpose() * v;
  system_.linear().excitation().at(t, end_.f);
  t_begin_ = t;
  index_   = 0;
  stepped_ = cut_ = false;
}

void OneStep::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  place(t, q, v);
  Instant &here = end_.motion;
  here.local.p.setZero();
  here.local.lambda.setZero();
  implicit_.begin(here.local.u);
  start_.project(here.q, here.v, here.local);
  start_.solve(here.q, here.v, end_.a, here.local, work_);
  end_.keep_balance();
}

void OneStep::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a)
{
  begin(t, q, v);
  end_.a                        = a;
  end_.motion.local.a.noalias() = system_.forces().directions().transpose() * a;
}

void OneStep::restart()
{
  if (cut_)
    std::swap(end_, cut_point_);
  implicit_.forget_contraction();
  Instant &here = end_.motion;
  t_begin_      = here.t;
  index_        = 0;
  stepped_ = cut_ = false;
  system_.linear().excitation().at(here.t, end_.f);
  start_.project(here.q, here.v, here.local);
  start_.solve(here.q, here.v, end_.a, here.local, work_);
  end_.keep_balance();
}

void OneStep::advance()
{
  if (cut_)
    restart();
  std::swap(begin_, end_);
  stepped_ = true;
  try
  {
    step_or_divide(begin_, step_, 0, end_);
  }
  catch (const ConvergenceFailure &)
  {
    std::swap(begin_, end_);
    stepped_ = false;
    throw;
  }
  ++index_;
  ++work_.steps;
  // The grid is kept free of what many additions of h would leave.
  end_.motion.t = end_.motion.local.t = t_begin_ + static_cast<double>(index_) * step_;
  const bool holds                    = !system_.forces().held().empty();
  if (holds) // this also finds the multipliers
    start_.hold(end_.motion.q, end_.motion.v, end_.motion.local, work_);
  end_.keep_balance();
  if (!holds && system_.joints().n_rows() > 0 && system_.joints().wants_multipliers())
    start_.find_multipliers(end_.motion.q, end_.motion.v, implicit_, end_.motion.local, work_);
}

void OneStep::step_or_divide(const Point &from, double length, int halvings, Point &to)
{
  try
  {
    to.motion.local.p      = from.p;
    to.motion.local.lambda = from.lambda;
    formula_step(from, length, to);
    to.keep_balance();
  }
  catch (const ConvergenceFailure &failure)
  {
    if (halvings >= max_halvings_)
    {
      std::ostringstream message;
      message << failure.what() << "; the step was halved " << halvings << " times, to " << length << " s";
      throw ConvergenceFailure(message.str(), failure.id(), failure.place());
    }
    ++work_.rejected;
    Point &middle = middle_[halvings];
    if (middle.a.size() == 0)
      resize(middle);
    step_or_divide(from, 0.5 * length, halvings + 1, middle);
    step_or_divide(middle, 0.5 * length, halvings + 1, to);
  }
}

void OneStep::interpolate(double t, LocalState &state) const
{
  if (!stepped_)
  {
    state = local();
    return;
  }
  const LocalState &a = begin_.motion.local, &b = end_.motion.local;
  const double      times[] = {a.t, b.t};
  const auto        weights = hermite_weights(times, 2, t);
  const auto &[L, H, D]     = std::tie(weights.lagrange, weights.value, weights.slope);
  const auto &[dH, dD]      = std::tie(weights.rate_value, weights.rate_slope);
  state.t                   = t;
  state.u                   = H[0] * a.u + H[1] * b.u + D[0] * a.v + D[1] * b.v;
  state.v                   = dH[0] * a.u + dH[1] * b.u + dD[0] * a.v + dD[1] * b.v;
  state.a                   = L[0] * a.a + L[1] * b.a;
  state.p                   = L[0] * a.p + L[1] * b.p;
  state.lambda              = L[0] * a.lambda + L[1] * b.lambda;
  if (system_.forces().held().empty())
    return;
  // Interpolates values only: q'' of modes that the step does not resolve would be that of the cubic.
  q_inside_ = L[0] * begin_.motion.q + L[1] * end_.motion.q;
  v_inside_ = L[0] * begin_.motion.v + L[1] * end_.motion.v;
  start_.hold(q_inside_, v_inside_, state, work_);
}

void OneStep::interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const
{
  const Instant &a = begin_.motion, &b = end_.motion;
  if (!stepped_)
  {
    q = b.q;
    v = b.v;
    return;
  }
  const double times[] = {a.t, b.t};
  const auto   weights = hermite_weights(times, 2, t);
  const auto &[H, D]   = std::tie(weights.value, weights.slope);
  const auto &[dH, dD] = std::tie(weights.rate_value, weights.rate_slope);
  q                    = H[0] * a.q + H[1] * b.q + D[0] * a.v + D[1] * b.v;
  v                    = dH[0] * a.q + dH[1] * b.q + dD[0] * a.v + dD[1] * b.v;
}

void OneStep::motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const
{
  if (!stepped_ || t == time())
  {
    TimeIntegrator::motion_at(t, coordinates, q, v);
    return;
  }
  const Instant &a = begin_.motion, &b = end_.motion;
  const double   times[] = {a.t, b.t};
  const auto     weights = hermite_weights(times, 2, t);
  const auto &[H, D]     = std::tie(weights.value, weights.slope);
  const auto &[dH, dD]   = std::tie(weights.rate_value, weights.rate_slope);
  for (const int i : coordinates)
  {
    q[i] = H[0] * a.q[i] + H[1] * b.q[i] + D[0] * a.v[i] + D[1] * b.v[i];
    v[i] = dH[0] * a.q[i] + dH[1] * b.q[i] + dD[0] * a.v[i] + dD[1] * b.v[i];
  }
}

void OneStep::cut(double t)
{
  cut_ = true;
  if (!(t > step_begin())) // the step is rejected: its end, which may not be finite, is ignored
  {
    cut_point_ = stepped_ ? begin_ : end_;
    return;
  }
  Instant &here = cut_point_.motion;
  interpolate(t, here.q, here.v);
  interpolate(t, here.local);
  keep_held_rates(system_, here.local.v);
  here.t = t;
  if (system_.joints().n_rows() > 0) // multipliers with the accuracy of q and q': a limiter may use them
    start_.solve(here.q, here.v, cut_point_.a, here.local, work_);
}

void OneStep::Point::keep_balance()
{
  p      = motion.local.p;
  lambda = motion.local.lambda;
}

void OneStep::Point::exchange(StateArchive &archive)
{
  archive(motion, a, f, p, lambda);
}

void OneStep::exchange(StateArchive &archive)
{
  archive(implicit_, start_, begin_, end_, cut_point_, t_begin_, index_, stepped_, cut_, work_);
}

} // namespace gestell::coupling
