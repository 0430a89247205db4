#include "coupling/integration/newmark/wilson.h"

namespace gestell::coupling
{

namespace
{

const Wilson::Options &checked(const Wilson::Options &options)
{
  if (!(options.theta >= 1.))
    throw std::invalid_argument("Wilson: theta is " + std::to_string(options.theta) + "; it must be 1 or more");
  return options;
}

} // namespace

Wilson::Wilson(const SecondOrderSystem &system, const Options &options)
    : OneStep(system, "Wilson", checked(options).step, options.max_halvings, options.newton), theta_(options.theta)
{
  if (system.joints().n_rows() > 0)
    throw std::invalid_argument("Wilson: not possible with ideal joints: it satisfies them at t + theta h, so they "
                                "drift at the end of each step; use bdf or generalised-alpha");
  for (Eigen::VectorXd *x : {&f_, &q_, &v_, &product_, &x_})
    x->setZero(system.linear().size());
  for (LocalState *state : {&base_, &ahead_})
    state->resize(system);
}

void Wilson::formula_step(const Point &from, double h, Point &to)
{
  const auto    &W     = system_.forces().directions();
  const double   tau   = theta_ * h;
  const Instant &start = from.motion;
  Instant       &end   = to.motion;

  // The motion at t + theta h for x = 0, and what x has to balance
  q_                = start.q + tau * start.v + (tau * tau / 3.) * from.a;
  v_                = start.v + (0.5 * tau) * from.a;
  base_.t           = start.t + tau;
  base_.u.noalias() = W.transpose() * q_;
  base_.v.noalias() = W.transpose() * v_;
  base_.a.setZero();
  ahead_.u = base_.u + (tau * tau / 6.) * start.local.a; // prediction: a_theta = a_0
  ahead_.p = start.local.p;
  system_.linear().excitation().at(start.t + h, to.f);
  f_ = (1. - theta_) * from.f + theta_ * to.f;
  system_.linear().damping_times(v_, product_);
  f_ -= product_;
  system_.linear().stiffness_times(q_, product_);
  f_ -= product_;
  f_ *= tau * tau;
  const StepForm form{1., 0.5 * tau, tau * tau / 6., tau * tau, 1. / 6., 0.5 / tau, 1. / (tau * tau), tau};
  implicit_.solve(implicit_.condensed(form, work_), f_, base_, x_, ahead_, work_);

  to.a  = (1. - 1. / theta_) * from.a + x_ / (theta_ * tau * tau);
  end.t = end.local.t   = start.t + h;
  end.q                 = start.q + h * start.v + (h * h / 6.) * (2. * from.a + to.a);
  end.v                 = start.v + (0.5 * h) * (from.a + to.a);
  end.local.u.noalias() = W.transpose() * end.q;
  end.local.v.noalias() = W.transpose() * end.v;
  end.local.a.noalias() = W.transpose() * to.a;
  // Rows of sticking measures keep the value at t + h of the line to t + theta h.
  end.local.p = start.local.p + (ahead_.p - start.local.p) / theta_;
  system_.forces().force(end.local, end.local.p);
  ++work_.evaluations;
}

} // namespace gestell::coupling
