#include "coupling/integration/bdf.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace gestell::coupling
{

namespace
{
[[noreturn]] void fail_divided(const std::string &reason, int halvings, double step)
{
  std::ostringstream message;
  message << reason << "; the step was halved " << halvings << " times, to " << step << " s";
  throw ConvergenceFailure(message.str());
}
} // namespace

Bdf::Bdf(const SecondOrderSystem &system, const Options &options)
    : system_(system), options_(options), implicit_(system, options.newton)
{
  if (options.order < 1 || options.order > 6)
    throw std::invalid_argument("BDF: order " + std::to_string(options.order) + "; orders 1 to 6 exist");
  if (!(options.step > 0.))
    throw std::invalid_argument("BDF: step " + std::to_string(options.step) + " s; it must be positive");
  if (system.n_constraints() > 0)
    throw std::invalid_argument("BDF: the system has " + std::to_string(system.n_constraints()) +
                                " constraints, which are not integrated in this version; use compliant joints");
  const int n = system.size(), n_u = static_cast<int>(system.directions().cols());
  for (Eigen::VectorXd *x : {&f_t_, &f_, &h_q_, &h_w_, &product_, &now_.q, &now_.v})
    x->setZero(n);
  for (Eigen::VectorXd *x :
       {&g_, &g_rate_, &p_, &local_.u, &local_.v, &local_.a, &now_.local.u, &now_.local.v, &now_.local.a, &now_.p})
    x->setZero(n_u);
  for (Point &point : points_)
    point = {f_, f_, f_, g_, g_};
}

void Bdf::load(double t)
{
  if (load_known_ && system_.excitation_is_constant())
    return;
  system_.excitation(t, f_t_);
  load_known_ = true;
}

void Bdf::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  t_begin_     = t;
  index_       = 0;
  newest_      = 0;
  n_past_      = 1;
  Point &first = points_[0];
  first.q      = q;
  first.v      = v;
  system_.mass_times(v, first.w);
  system_.damping_times(q, product_);
  first.w += product_;
  first.u.noalias()      = system_.directions().transpose() * q;
  first.u_rate.noalias() = system_.directions().transpose() * v;
  implicit_.begin(first.u);
  local_.t = t;
  local_.u = first.u;
  local_.v = first.u_rate;
  local_.a.setZero();
  system_.local_force(local_, p_);
  publish(t);
}

void Bdf::publish(double t)
{
  now_.t     = t;
  now_.q     = past(0).q;
  now_.v     = past(0).v;
  now_.local = local_;
  now_.p     = p_;
}

Bdf::Point &Bdf::push()
{
  newest_ = (newest_ + 1) % capacity;
  n_past_ = std::min(n_past_ + 1, capacity - 1);
  return points_[newest_];
}

void Bdf::advance()
{
  const double t = t_begin_ + static_cast<double>(index_ + 1) * options_.step;
  if (n_past_ < options_.order)
    start_value(t);
  else
    multistep(t);
  ++index_;
  ++work_.steps;
  publish(t);
}

void Bdf::multistep(double t)
{
  const Point *points[6];
  for (int i = 0; i < options_.order; ++i)
    points[i] = &past(i);
  Point &to = points_[(newest_ + 1) % capacity];
  try
  {
    // Prediction by extrapolation of the measures, one order above what the first points give.
    if (n_past_ >= 3)
      local_.u = 3. * (past(0).u - past(1).u) + past(2).u;
    else if (n_past_ == 2)
      local_.u = 2. * past(0).u - past(1).u;
    else
      local_.u = past(0).u + options_.step * past(0).u_rate;
    formula_step(options_.order, points, t, options_.step, to);
  }
  catch (const ConvergenceFailure &)
  {
    ++work_.rejected;
    divided_step(past(0), t - options_.step, options_.step, 1, to);
  }
  push();
}

void Bdf::formula_step(int order, const Point *const *past, double t, double step, Point &to)
{
  const BdfFormula &formula = bdf_formulas[order - 1];
  const double      h_beta  = formula.beta0 * step;
  h_q_                      = -formula.alpha[0] * past[0]->q;
  h_w_                      = -formula.alpha[0] * past[0]->w;
  g_rate_                   = -formula.alpha[0] * past[0]->u_rate;
  g_                        = -formula.alpha[0] * past[0]->u;
  for (int i = 1; i < order; ++i)
  {
    h_q_ -= formula.alpha[i] * past[i]->q;
    h_w_ -= formula.alpha[i] * past[i]->w;
    g_rate_ -= formula.alpha[i] * past[i]->u_rate;
    g_ -= formula.alpha[i] * past[i]->u;
  }
  load(t);
  system_.mass_times(h_q_, f_);
  f_ += h_beta * h_w_ + (h_beta * h_beta) * f_t_;
  implicit_.solve(implicit_.condensed(h_beta, work_), t, f_, g_, g_rate_, to.q, local_, p_, work_);

  to.v      = (1. / h_beta) * (to.q - h_q_);
  to.u      = local_.u;
  to.u_rate = local_.v;
  system_.stiffness_times(to.q, product_);
  to.w          = h_w_ + h_beta * (f_t_ - product_);
  const auto &W = system_.directions();
  for (int j = 0; j < W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
      to.w[it.row()] += h_beta * it.value() * p_[j];
}

void Bdf::divided_step(const Point &from, double t, double length, int halvings, Point &to)
{
  const double half   = 0.5 * length;
  const Point  start  = from;
  Point        middle = from;
  for (int part = 0; part < 2; ++part)
  {
    const Point *begin    = part == 0 ? &start : &middle;
    Point       &end      = part == 0 ? middle : to;
    const Point  base     = *begin;
    const Point *points[] = {&base};
    try
    {
      local_.u = base.u + half * base.u_rate;
      formula_step(1, points, t + (part + 1) * half, half, end);
    }
    catch (const ConvergenceFailure &failure)
    {
      if (halvings == options_.max_halvings)
        fail_divided(failure.what(), halvings, half);
      ++work_.rejected;
      divided_step(base, t + part * half, half, halvings + 1, end);
    }
  }
}

void Bdf::euler_chain(const Point &from, double t, double length, int n, Point &to)
{
  Point        base = from;
  const double step = length / n;
  for (int i = 0; i < n; ++i)
  {
    const Point *points[] = {&base};
    try
    {
      local_.u = base.u + step * base.u_rate;
      formula_step(1, points, t + (i + 1) * step, step, to);
    }
    catch (const ConvergenceFailure &)
    {
      ++work_.rejected;
      divided_step(base, t + i * step, step, 1, to);
    }
    base = to;
  }
}

void Bdf::start_value(double t)
{
  const int          order = options_.order;
  const double       h     = options_.step;
  std::vector<Point> table(order, past(0)); // Neville's table, newest column in place
  for (int j = 0; j < order; ++j)
  {
    euler_chain(past(0), t - h, h, j + 1, table[j]);
    for (int k = j - 1; k >= 0; --k)
    {
      // table[k] becomes the value of order j - k + 1 from the chains k + 1 .. j + 1
      const double weight = 1. / (static_cast<double>(j + 1) / (k + 1) - 1.);
      const auto   refine = [&](Eigen::VectorXd Point::*x)
      { table[k].*x = table[k + 1].*x + weight * (table[k + 1].*x - table[k].*x); };
      for (auto x : {&Point::q, &Point::v, &Point::w, &Point::u, &Point::u_rate})
        refine(x);
    }
  }
  push()   = table[0];
  local_.t = t;
  local_.u = past(0).u;
  local_.v = past(0).u_rate;
  local_.a.setZero();
  system_.local_force(local_, p_);
}

} // namespace gestell::coupling
