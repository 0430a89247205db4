#include "coupling/integration/newmark/newmark.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{

void require(bool valid, const char *method, const char *parameter, double value, const char *needed)
{
  if (valid)
    return;
  std::ostringstream message;
  message << method << ": " << parameter << " is " << value << "; it must be " << needed;
  throw std::invalid_argument(message.str());
}

const Newmark::Options &checked(const Newmark::Options &o)
{
  require(o.beta >= 0., "Newmark", "beta", o.beta, "zero or positive");
  require(o.gamma > 0., "Newmark", "gamma", o.gamma, "positive");
  require(o.alpha_m < 1., "Newmark", "alpha_m", o.alpha_m, "below 1");
  require(o.alpha_f >= 0. && o.alpha_f < 1., "Newmark", "alpha_f", o.alpha_f, "zero or more and below 1");
  return o;
}

/// A joint is an infinitely stiff spring: its roots are those for omega h = infinity, which must be damped.
void refuse_with_joints(const Newmark::Options &o)
{
  const std::string way = "; use bdf, or generalised-alpha with rho_inf below 1, or hht with alpha below 0";
  if (o.beta == 0.)
    throw std::invalid_argument("central differences: not possible with ideal joints, because new positions are "
                                "computed without the joint forces of the step; use bdf");
  if (o.gamma <= 0.5)
    throw std::invalid_argument(
        "Newmark: without numerical damping the forces of ideal joints oscillate from step to step without decay" +
        way);
  if (o.alpha_m == 0. && o.alpha_f == 0. && 2. * o.beta <= o.gamma)
  {
    std::ostringstream message;
    message << "Newmark: beta is " << o.beta << ", and with ideal joints it must be above gamma/2 = " << 0.5 * o.gamma
            << ": otherwise their forces grow or oscillate from step to step, at any step size" << way;
    throw std::invalid_argument(message.str());
  }
}

} // namespace

Newmark::Options Newmark::hht(double alpha)
{
  require(alpha >= -1. / 3. && alpha <= 0., "HHT", "alpha", alpha, "between -1/3 and 0");
  Options options;
  options.alpha_f = -alpha;
  options.beta    = 0.25 * (1. - alpha) * (1. - alpha);
  options.gamma   = 0.5 - alpha;
  return options;
}

Newmark::Options Newmark::generalised_alpha(double rho_inf)
{
  require(rho_inf >= 0. && rho_inf <= 1., "generalised alpha", "rho_inf", rho_inf, "between 0 and 1");
  Options options;
  options.alpha_m    = (2. * rho_inf - 1.) / (rho_inf + 1.);
  options.alpha_f    = rho_inf / (rho_inf + 1.);
  const double shift = options.alpha_f - options.alpha_m;
  options.beta       = 0.25 * (1. + shift) * (1. + shift);
  options.gamma      = 0.5 + shift;
  return options;
}

Newmark::Options Newmark::central_difference()
{
  Options options;
  options.beta  = 0.;
  options.gamma = 0.5;
  return options;
}

Newmark::Newmark(const SecondOrderSystem &system, const Options &options)
    : OneStep(system, "Newmark", checked(options).step, options.max_halvings, options.newton), options_(options)
{
  if (system.joints().n_rows() > 0)
    refuse_with_joints(options);
  for (Eigen::VectorXd *x : {&f_, &mean_, &product_, &x_})
    x->setZero(system.linear().size());
  base_.resize(system);
}

void Newmark::formula_step(const Point &from, double h, Point &to)
{
  const auto &[beta, gamma, alpha_m, alpha_f, step, max_halvings, newton] = options_;
  const auto    &W                                                        = system_.forces().directions();
  const double   end_f = 1. - alpha_f, weight = h * h / (1. - alpha_m); // the equation is divided by (1 - alpha_m)/h^2
  const double   shift = alpha_m - alpha_f;                             // of the instant that a belongs to, in steps
  const Instant &start = from.motion;
  Instant       &end   = to.motion;

  // The motion for x = 0 ...
  end.t             = start.t + h;
  end.q             = start.q + h * start.v + (h * h * (0.5 - beta)) * from.a;
  end.v             = start.v + (h * (1. - gamma)) * from.a;
  base_.t           = end.t;
  base_.u.noalias() = W.transpose() * end.q;
  base_.v.noalias() = W.transpose() * end.v;
  base_.a.noalias() = W.transpose() * from.a;
  end.local.u       = base_.u + (h * h * beta) * base_.a; // prediction: a_1 = a_0
  if (implicit_.is_sparse())
    x_ = (h * h) * from.a;
  base_.a *= shift;

  // ... and what x has to balance
  system_.linear().excitation().at(end.t, to.f);
  f_ = (weight * end_f) * to.f;
  if (alpha_f != 0.)
  {
    f_ += (weight * alpha_f) * from.f;
    for (int j = 0; j < W.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
        f_[it.row()] += weight * alpha_f * it.value() * from.p[j];
  }
  if (alpha_m != 0.)
  {
    system_.linear().mass_times(from.a, product_);
    f_ -= (weight * alpha_m) * product_;
  }
  mean_ = end_f * end.v + alpha_f * start.v;
  system_.linear().damping_times(mean_, product_);
  f_ -= weight * product_;
  mean_ = end_f * end.q + alpha_f * start.q;
  system_.linear().stiffness_times(mean_, product_);
  f_ -= weight * product_;

  const double   force = weight * end_f;
  const StepForm form{1., force * gamma / h, force * beta, force, beta, gamma / h, (1. - shift) / (h * h), h};
  implicit_.solve(implicit_.condensed(form, work_), f_, base_, x_, end.local, work_);
  end.q += beta * x_;
  end.v += (gamma / h) * x_;
  to.a = x_ / (h * h);
}

} // namespace gestell::coupling
