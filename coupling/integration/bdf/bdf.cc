#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/step/directions.h"
#include "coupling/integration/system/acceleration_forces.h"

#include <algorithm>
#include <vector>

namespace gestell::coupling
{

Bdf::Bdf(const SecondOrderSystem &system, const Options &options)
    : system_(system), options_(options), implicit_(system, options.newton), virtual_rates_(system),
      load_on_grid_(system.linear().excitation())
{
  if (options.order < 1 || options.order > 6)
    throw std::invalid_argument("BDF: order " + std::to_string(options.order) + "; orders 1 to 6 exist");
  if (!(options.step > 0.))
    throw std::invalid_argument("BDF: step " + std::to_string(options.step) + " s; it must be positive");
  const int n = system.linear().size(), n_u = static_cast<int>(system.forces().directions().cols());
  for (Eigen::VectorXd *x : {&f_here_, &f_, &h_q_, &h_w_, &product_, &now_.q, &now_.v, &q_inside_, &v_inside_})
    x->setZero(n);
  g_.setZero(n_u);
  g_rate_.setZero(n_u);
  for (LocalState *state : {&local_, &base_, &now_.local})
    state->resize(system);
  for (Point &point : points_)
    point = {0., f_, f_, f_, g_, g_, g_, g_, local_.lambda};
  cut_point_ = points_[0];
}

void Bdf::load(double t)
{
  if (load_known_ && system_.linear().excitation().is_constant())
    return;
  system_.linear().excitation().at(t, f_here_);
  load_known_ = true;
  on_grid_    = false;
}

/// The same at the end of step k.
void Bdf::load_on_grid(long k)
{
  if (load_known_ && system_.linear().excitation().is_constant())
    return;
  load_on_grid_.find(t_begin_, options_.step, k);
  load_known_ = on_grid_ = true;
}

void Bdf::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  newest_ = 0;
  local_.p.setZero();
  local_.lambda.setZero();
  set(t, q, v);
  implicit_.begin(past(0).u);
  begin_from(t);
}

void Bdf::begin(double t, const std::vector<Eigen::VectorXd> &q, const std::vector<Eigen::VectorXd> &v)
{
  const int n = static_cast<int>(q.size());
  if (n == 0 || n >= capacity || v.size() != q.size())
    throw std::invalid_argument("BDF: a history of " + std::to_string(n) + " points q and " + std::to_string(v.size()) +
                                " points v; it needs as many of both, 1 to " + std::to_string(capacity - 1));
  newest_ = 0;
  local_.p.setZero();
  local_.lambda.setZero();
  for (int i = n - 1; i >= 0; --i)
  {
    push();
    set(t - i * options_.step, q[i], v[i]);
    begin_from(past(0).t);
  }
  n_past_ = n;
  implicit_.begin(past(0).u);
}

/// The newest point becomes t, q, v with their measures.
void Bdf::set(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  Point &point           = past(0);
  point.t                = t;
  point.q                = q;
  point.v                = v;
  point.u.noalias()      = system_.forces().directions().transpose() * q;
  point.u_rate.noalias() = system_.forces().directions().transpose() * v;
}

/// Starts at past(0), with known q, v, u, u'.
void Bdf::begin_from(double t)
{
  implicit_.forget_contraction();
  t_begin_     = t;
  index_       = 0;
  n_past_      = 1;
  cut_         = false;
  Point &first = past(0);
  first.t      = t;
  system_.linear().mass_times(first.v, first.w);
  system_.linear().damping_times(first.q, product_);
  first.w += product_;
  local_.t = t;
  local_.u = first.u;
  local_.v = first.u_rate;
  local_.a.setZero();
  system_.forces().force(local_, local_.p);
  ++work_.evaluations;
  first.a      = local_.a;
  first.p      = local_.p;
  first.lambda = local_.lambda;
  if (is_implied())
  {
    if (system_.joints().n_rows() > 0 && has_consistent())
      consistent_->project(first.q, first.v, local_);
    first.u      = local_.u;
    first.u_rate = local_.v;
    system_.linear().mass_times(first.v, first.w);
    system_.linear().damping_times(first.q, product_);
    first.w += product_;
    find_implied(first);
  }
  else
  {
    ++work_.evaluations;
    if (depend_on_accelerations(system_, local_)) // the first row must contain forces like the later ones
      find_implied(first);
  }
  virtual_rates_.settle(first.q, first.v, local_);
  first.u_rate = local_.v;
  now_known_   = false;
}

bool Bdf::is_implied() const
{
  return system_.joints().n_rows() > 0 || !system_.forces().held().empty();
}

/// With a singular M there is no acceleration, and the first step determines the forces.
bool Bdf::has_consistent()
{
  if (!consistent_ && !massless_)
    try
    {
      consistent_ = std::make_unique<ConsistentStart>(system_, "BDF", options_.newton.joints);
    }
    catch (const std::invalid_argument &)
    {
      massless_ = true;
    }
  return consistent_ != nullptr;
}

/// Forces of sticking measures and joints, from the equation of motion at a point.
void Bdf::find_implied(Point &point)
{
  if (!has_consistent())
    return;
  present(point);
  consistent_->solve(point.q, point.v, product_, local_, work_);
  keep_implied(point);
}

void Bdf::keep_implied(Point &point) const
{
  point.a      = local_.a;
  point.p      = local_.p;
  point.lambda = local_.lambda;
}

/// Whether a measure sticks, and the equation of motion gives its force.
bool Bdf::finds_held() const
{
  return consistent_ && !system_.forces().held().empty();
}

void Bdf::restart()
{
  if (cut_)
  {
    push();
    past(0) = cut_point_;
  }
  begin_from(past(0).t);
}

/// Copies the measures of a point to the present instant.
void Bdf::present(const Point &point)
{
  local_.t      = point.t;
  local_.u      = point.u;
  local_.v      = point.u_rate;
  local_.a      = point.a;
  local_.p      = point.p;
  local_.lambda = point.lambda;
  now_known_    = false;
}

const Instant &Bdf::instant() const
{
  if (!now_known_)
  {
    const Point &point = cut_ ? cut_point_ : past(0);
    now_.t             = point.t;
    now_.q             = point.q;
    now_.v             = point.v;
    now_.local         = local_;
    now_known_         = true;
  }
  return now_;
}

void Bdf::push()
{
  newest_ = (newest_ + 1) % capacity;
  n_past_ = std::min(n_past_ + 1, capacity - 1);
}

void Bdf::advance()
{
  if (cut_)
    restart();
  now_known_     = false;
  const double t = t_begin_ + static_cast<double>(index_ + 1) * options_.step;
  try
  {
    if (n_past_ < options_.order)
      start_value(t);
    else
      multistep(t);
  }
  catch (const ConvergenceFailure &)
  {
    present(past(0));
    throw;
  }
  ++index_;
  ++work_.steps;
}

void Bdf::cut(double t)
{
  if (!(t > step_begin())) // the step is rejected: its end, which may not be finite, is ignored
  {
    cut_point_ = past(n_past_ > 1 ? 1 : 0);
    cut_       = true;
    present(cut_point_);
    return;
  }
  interpolate(t, cut_point_.q, cut_point_.v);
  interpolate(t, base_);
  keep_held_rates(system_, base_.v);
  cut_point_.t      = t;
  cut_point_.u      = base_.u;
  cut_point_.u_rate = base_.v;
  cut_point_.a      = base_.a;
  cut_point_.p      = base_.p;
  cut_point_.lambda = base_.lambda;
  if (system_.joints().n_rows() > 0) // multipliers with the accuracy of q and q': a limiter may use them
    find_implied(cut_point_);
  cut_ = true;
  present(cut_point_);
}

void Bdf::multistep(double t)
{
  const Point *points[6];
  for (int i = 0; i < options_.order; ++i)
    points[i] = &past(i);
  Point &to = points_[(newest_ + 1) % capacity];
  try
  {
    if (implicit_.is_sparse())
    {
      predict(&Point::q, &Point::v, to.q);
      predict(&Point::lambda, nullptr, lambda_);
      if (system_.forces().need_multipliers()) // friction lags one iteration, and there may be only one
        local_.lambda = lambda_;
    }
    else
      predict(&Point::u, &Point::u_rate, local_.u);
    implicit_.expect_good_predictions(options_.order <= 2 && n_past_ >= 3);
    load_on_grid(index_ + 1);
    formula_step(options_.order, points, t, options_.step, to);
    implicit_.expect_good_predictions(false);
  }
  catch (const ConvergenceFailure &)
  {
    implicit_.expect_good_predictions(false);
    ++work_.rejected;
    divided_step(past(0), options_.step, 1, to);
  }
  push();
  if (system_.joints().n_rows() > 0)
  {
    if (index_ + 1 < 2 * options_.order)
      find_implied(past(0));
    else if (consistent_ && system_.joints().wants_multipliers())
    {
      if (implicit_.is_sparse())
        local_.lambda = lambda_;
      consistent_->find_multipliers(past(0).q, past(0).v, implicit_, local_, work_);
      keep_implied(past(0));
    }
  }
  else if (finds_held())
  {
    consistent_->hold(past(0).q, past(0).v, local_, work_);
    past(0).p = local_.p;
  }
}

/// Predicts by extrapolation, one order higher than that of the first points.  Many joints are worth six points: in a
/// smooth motion Newton's first correction is then so small that nothing turns by it.
void Bdf::predict(Eigen::VectorXd Point::*x, Eigen::VectorXd Point::*rate, Eigen::VectorXd &to) const
{
  if (implicit_.is_sparse() && n_past_ >= 6)
    to = 6. * (past(0).*x + past(4).*x) - 15. * (past(1).*x + past(3).*x) + 20. * past(2).*x - past(5).*x;
  else if (n_past_ >= 3)
    to = 3. * (past(0).*x - past(1).*x) + past(2).*x;
  else if (n_past_ == 2)
    to = 2. * past(0).*x - past(1).*x;
  else if (rate)
    to = past(0).*x + options_.step * past(0).*rate;
  else
    to = past(0).*x;
}

void Bdf::formula_step(int order, const Point *const *past, double t, double step, Point &to)
{
  const BdfFormula &formula = bdf_formulas[order - 1];
  const double      h_beta = formula.beta0 * step, inverse = 1. / h_beta;
  const auto        history = [&](Eigen::VectorXd Point::*x, Eigen::VectorXd &to)
  {
    if (order == 2) // in one pass
      to = -formula.alpha[0] * past[0]->*x - formula.alpha[1] * past[1]->*x;
    else
      to = -formula.alpha[0] * past[0]->*x;
    for (int i = 1; i < order && order != 2; ++i)
      to -= formula.alpha[i] * past[i]->*x;
  };
  history(&Point::q, h_q_);
  history(&Point::w, h_w_);
  history(&Point::u_rate, g_rate_);
  history(&Point::u, g_);
  const Eigen::VectorXd &f_t = on_grid_ ? load_on_grid_.value() : f_here_;
  f_                         = h_beta * h_w_ + (h_beta * h_beta) * f_t;
  base_.t                    = t;
  base_.u.setZero();
  base_.v = -inverse * g_;
  base_.a = inverse * (base_.v - g_rate_);
  const StepForm form{1., h_beta, h_beta * h_beta, h_beta * h_beta, 1., inverse, inverse * inverse, h_beta};
  implicit_.solve(implicit_.condensed(form, work_), ImplicitStep::MassLoad{h_q_, f_}, base_, to.q, local_, work_);

  to.t      = t;
  to.v      = inverse * (to.q - h_q_);
  to.u      = local_.u;
  to.u_rate = local_.v;
  to.a      = local_.a;
  to.p      = local_.p;
  to.lambda = local_.lambda;
  system_.linear().stiffness_times(to.q, product_);
  to.w = h_w_ + h_beta * (f_t - product_);
  add_forces(system_.forces().directions(), h_beta, local_.p, to.w);
}

} // namespace gestell::coupling
