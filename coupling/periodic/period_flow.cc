#include "coupling/periodic/period_flow.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/step/varied_motion.h"
#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What is not said of the integration.
MethodOptions completed(const MethodOptions &given, double period)
{
  MethodOptions    options = given;
  constexpr double fine    = 1e-11; // tolerance of steps where none is given
  if (!(options.step > 0.) && !(options.tolerance > 0.))
    options.tolerance = fine;
  constexpr double longest_step = 1. / 64.; // of a period
  if (!(options.step > 0.) || options.step > longest_step * period)
    options.step = longest_step * period;
  return options;
}
} // namespace

double still_speed(const SecondOrderSystem &system, const VectorXd &q, const VectorXd &v, double period)
{
  if (system.forces().directions().cols() == 0)
    return 0.;
  constexpr double at_rest = 1e-9; // sliding speed that is none, of the motion: its rounding
  return at_rest * (v.cwiseAbs().maxCoeff() + 2. * M_PI / period * q.cwiseAbs().maxCoeff());
}

VectorXd without_free(const PeriodicProblem &problem, const VectorXd &x)
{
  return problem.has_free_shifts() ? VectorXd(x - problem.free * (problem.free.transpose() * x)) : x;
}

VectorXd turned(const PeriodicProblem &problem, const PeriodPassage &passage)
{
  return passage.shift.size() > 0 ? VectorXd(problem.turn + passage.shift) : problem.turn;
}

PeriodFlow::PeriodFlow(const PeriodicProblem &problem, const MethodOptions &integration)
    : problem_(problem), system_(*problem.system), integration_(completed(integration, problem.period)),
      motion_(system_, make_integrator(system_, integration_)), integrator_(motion_.integrator()),
      tangents_(dynamic_cast<MotionTangents *>(&integrator_))
{
  own_tangents_ = tangents_ != nullptr;
  motion_.watch(*this);
  local_look_.resize(system_);
  q_look_.setZero(system_.linear().size());
  v_look_ = q_look_;
}

PeriodFlow::~PeriodFlow() = default;

void PeriodFlow::look_on(int samples, std::function<void(const OrbitPoint &)> look)
{
  std::vector<double> shares;
  for (int k = 0; k <= samples && samples > 0; ++k)
    shares.push_back(double(k) / samples);
  look_at(std::move(shares), std::move(look));
}

void PeriodFlow::look_at(std::vector<double> shares, std::function<void(const OrbitPoint &)> look)
{
  looks_ = std::move(shares);
  look_  = std::move(look);
}

void PeriodFlow::carry(const MatrixXd &dq, const MatrixXd &dv)
{
  dq_begin_ = dq;
  dv_begin_ = dv;
}

void PeriodFlow::carry_all()
{
  const Index n = problem_.turn.size();
  dq_begin_.resize(n, 2 * n);
  dv_begin_.resize(n, 2 * n);
  dq_begin_ << MatrixXd::Identity(n, n), MatrixXd::Zero(n, n);
  dv_begin_ << MatrixXd::Zero(n, n), MatrixXd::Identity(n, n);
}

void PeriodFlow::start(const VectorXd &q, const VectorXd &v, double begin, double end, bool tangents)
{
  if (tangents && !tangents_)
  {
    varied_   = std::make_unique<VariedMotion>(system_, integrator_);
    tangents_ = varied_.get();
  }
  passage_         = {};
  passage_.q_begin = q;
  passage_.v_begin = v;
  passage_.fastest = v.norm();
  carries_         = tangents;
  begin_           = begin;
  end_             = end;
  shown_           = 0;
  at_turn_         = nullptr;
  t_event_         = -std::numeric_limits<double>::infinity();
  for (VectorXd &largest : largest_)
    largest.setZero(system_.forces().directions().cols());
  motion_.begin(begin, q, v, {true, end, still_speed(system_, q, v, problem_.period)});
  if (tangents)
  {
    if (dq_begin_.size() == 0)
      carry_all();
    tangents_->begin_tangents(dq_begin_, dv_begin_);
    tangents_->tangents(dq_start_, dv_start_);
  }
}

const PeriodPassage &PeriodFlow::pass(const VectorXd &q, const VectorXd &v, double period, bool tangents)
{
  if (tangents && !own_tangents_ && dq_begin_.size() == 0)
    return pass_condensed(q, v, period);
  pass_part(q, v, problem_.begin, problem_.begin + period, tangents);
  passage_.period = period;
  put_back(q);
  return passage_;
}

const PeriodPassage &PeriodFlow::pass_condensed(const VectorXd &q, const VectorXd &v, double period)
{
  const Index n     = q.size();
  const auto  looks = std::exchange(looks_, {});
  if (weights_.size() == 0)
    weights_ = energy_roots(system_.linear(), 2. * M_PI / problem_.period);
  PeriodicWork work;
  const auto   passed = [&](bool tangents)
  {
    pass(q, v, period, tangents);
    work.add({0, 1, passage_.work});
  };
  const auto images = [&](MatrixXd X) -> PassageDerivative::Images
  {
    X.array().colwise() /= weights_.array();
    carry(X.topRows(n), X.bottomRows(n));
    passed(true);
    X << dq_start_, dv_start_;
    return {weights_.asDiagonal() * X, weights_.asDiagonal() * passage_.monodromy};
  };
  MatrixXd monodromy;
  try
  {
    monodromy = derivative_.monodromy(2 * n, images);
  }
  catch (...)
  {
    carry({}, {});
    looks_ = looks;
    throw;
  }
  carry({}, {});
  monodromy.array().colwise() /= weights_.array();
  monodromy.array().rowwise() *= weights_.transpose().array();
  looks_ = looks;
  if (!looks_.empty())
    passed(false);
  passage_.monodromy = std::move(monodromy);
  passage_.work      = work.integration;
  passage_.runs      = work.periods;
  passage_.condensed = derivative_.is_condensed();
  return passage_;
}

void PeriodFlow::put_back(const VectorXd &q)
{
  if (!problem_.has_free_shifts())
    return;
  const MatrixXd &F = problem_.free;
  passage_.shift    = F * (F.transpose() * (passage_.q - q - problem_.turn));
  passage_.q -= passage_.shift;
  if (auto dq = passage_.monodromy.topRows(passage_.monodromy.rows() / 2); dq.size() > 0)
    dq -= MatrixXd(F * (F.transpose() * dq));
}

const PeriodPassage &PeriodFlow::pass_part(const VectorXd &q, const VectorXd &v, double from, double to, bool tangents)
{
  const IntegrationWork before = integrator_.work();
  start(q, v, from, to, tangents);
  motion_.to_end(
      [&]
      {
        require_few(integrator_.work().steps - before.steps);
        return true;
      });
  passage_.period = to - from;
  passage_.q      = integrator_.instant().q;
  passage_.v      = integrator_.instant().v;
  finish(before);
  return passage_;
}

const PeriodPassage &PeriodFlow::pass_turn(const VectorXd &q, const VectorXd &v, double longest)
{
  const IntegrationWork before = integrator_.work();
  const int             phase  = problem_.phase;
  const double          from = q[phase], target = problem_.phase_value + problem_.turn[phase],
               direction = problem_.turn[phase] < 0. || problem_.phase_falls ? -1. : 1.;
  start(q, v, problem_.begin, problem_.begin + longest, false);
  bool there = false;
  at_turn_   = [&]
  {
    // The way of an oscillation begins and ends at the same value: what counts is the crossing in its direction,
    // that of the turn, and without one upwards unless the phase falls.
    const auto past = [&](double t)
    {
      integrator_.interpolate(t, q_look_, v_look_);
      return direction * (q_look_[phase] - target);
    };
    double low = integrator_.step_begin(), high = integrator_.time();
    if (there || !(high > low) || !(past(low) < 0.) || !(past(high) >= 0.))
      return;
    for (int k = 0; k < 60 && high - low > 1e-15 * (high - problem_.begin); ++k)
    {
      const double middle              = 0.5 * (low + high);
      (past(middle) < 0. ? low : high) = middle;
    }
    past(high);
    there           = true;
    passage_.period = high - problem_.begin;
    passage_.q      = q_look_;
    passage_.v      = v_look_;
  };
  motion_.to_end(
      [&]
      {
        require_few(integrator_.work().steps - before.steps);
        return !there;
      });
  finish(before);
  if (there)
  {
    put_back(q);
    return passage_;
  }
  std::ostringstream text;
  text << "the coordinate " << system_.linear().coordinate_name(phase) << " does not complete a revolution in "
       << longest << " s: it goes from " << from << " to " << integrator_.instant().q[phase]
       << ", but a period ends at " << target;
  throw NoPeriodicMotion(text.str());
}

void PeriodFlow::require_few(long steps) const
{
  if (problem_.interrupted())
    throw SearchInterrupted();
  if (steps > problem_.most_steps)
    throw ConvergenceFailure("a period needs more than " + std::to_string(problem_.most_steps) +
                             " steps; use a larger tolerance");
}

void PeriodFlow::finish(const IntegrationWork &before)
{
  passage_.events              = motion_.driver().events();
  const IntegrationWork &now   = integrator_.work();
  passage_.work.steps          = now.steps - before.steps;
  passage_.work.rejected       = now.rejected - before.rejected;
  passage_.work.newton         = now.newton - before.newton;
  passage_.work.factorisations = now.factorisations - before.factorisations;
  passage_.work.solves         = now.solves - before.solves;
  passage_.work.evaluations    = now.evaluations - before.evaluations;
  if (motion_.driver().chattering_steps() > 0)
    passage_.chattering = motion_.driver().chattering_time() / (end_ - begin_);
  if (!carries_)
    return;
  MatrixXd dq, dv;
  tangents_->tangents(dq, dv);
  passage_.monodromy.resize(2 * dq.rows(), dq.cols());
  passage_.monodromy << dq, dv;
}

bool PeriodFlow::remembers_at_end()
{
  if (!system_.forces().held().empty())
    return true;
  EventSystem   &elements   = system_.events();
  const VectorXd remembered = elements.save_history();
  LocalState     state      = integrator_.local();
  state.a.setZero(); // as EventDriver::begin()
  state.p.setZero();
  elements.follow_history(false);
  elements.start(state);
  const VectorXd   anew         = elements.save_history();
  constexpr double same_history = 1e-12; // relative difference of numbers that elements remember
  return remembered.size() != anew.size() ||
         !((remembered - anew).cwiseAbs().array() <= same_history * remembered.cwiseAbs().array()).all();
}

const VectorXd &PeriodFlow::end_acceleration()
{
  const LinearSystem &linear = system_.linear();
  if (!mass_)
    mass_ = linear.factorise(1., 0., 0.);
  const LocalState &local = integrator_.local();
  const Instant    &now   = integrator_.instant();
  VectorXd          f(now.q.size()), product(now.q.size());
  linear.excitation().at(local.t, f);
  linear.damping_times(now.v, product);
  f -= product;
  linear.stiffness_times(now.q, product);
  f -= product;
  f += system_.forces().directions() * local.p;
  acceleration_.resize(f.size());
  mass_->solve(f, acceleration_);
  return acceleration_;
}

void PeriodFlow::step()
{
  const LocalState &local = integrator_.local();
  if (carries_)
    tangents_->carry_tangents();
  largest_[0]      = largest_[0].cwiseMax(local.u.cwiseAbs());
  largest_[1]      = largest_[1].cwiseMax(local.v.cwiseAbs());
  largest_[2]      = largest_[2].cwiseMax(local.a.cwiseAbs());
  largest_[3]      = largest_[3].cwiseMax(local.p.cwiseAbs());
  passage_.fastest = std::max(passage_.fastest, integrator_.instant().v.norm());
  if (!looks_.empty())
    show(integrator_.time());
  if (at_turn_)
    at_turn_();
}

void PeriodFlow::show(double until)
{
  for (; shown_ < looks_.size(); ++shown_)
  {
    const double     t        = begin_ + (end_ - begin_) * looks_[shown_];
    constexpr double rounding = 1e-12; // of a period: the end is reached
    const bool       last     = looks_[shown_] == 1. && until >= end_ - rounding * (end_ - begin_);
    if (t > until && !last)
      return;
    const double at = std::clamp(t, integrator_.step_begin(), until);
    integrator_.interpolate(at, local_look_);
    integrator_.interpolate(at, q_look_, v_look_);
    look_({at, q_look_, v_look_, local_look_});
  }
}

/// Gradient of a guard in u, v, a, p [n_u x 4], and its derivative with respect to the time alone; by differences,
/// which are exact for the linear functions that nearly all guards are.
void PeriodFlow::find_slopes(int guard, MatrixXd &gradient, double &partial)
{
  const EventSystem &events = system_.events();
  LocalState         at     = integrator_.local();
  VectorXd           g      = VectorXd::Zero(events.n_guards());
  const auto         slope  = [&](double &x, double way)
  {
    const double here = x;
    x                 = here + way;
    const double up   = x;
    events.guard_values(at, g);
    const double above = g[guard];
    x                  = here - way;
    const double down  = x;
    events.guard_values(at, g);
    x = here;
    return (above - g[guard]) / (up - down);
  };
  VectorXd *const  parts[]   = {&at.u, &at.v, &at.a, &at.p};
  constexpr double small_way = 1e-5; // over which gradients of guards are taken, of the largest motion so far
  for (int part = 0; part < 4; ++part)
    for (Index i = 0; i < gradient.rows(); ++i)
    {
      const double largest = largest_[part][i];
      gradient(i, part)    = slope((*parts[part])[i], largest > 0. ? small_way * largest : small_way);
    }
  partial = slope(at.t, small_way * problem_.period);
}

void PeriodFlow::guard(int number)
{
  if (!carries_)
    return;
  before_ = integrator_.local().p;
  jumps_  = true;
  if (integrator_.time() == t_event_)
    return; // follows at once from the event before: its time moves with it
  t_event_ = integrator_.time();
  MatrixXd gradient(before_.size(), 4);
  double   partial = 0.;
  find_slopes(number, gradient, partial);
  const auto along = [&](const LocalTangents &x) -> Eigen::RowVectorXd
  {
    return gradient.col(0).transpose() * x.u + gradient.col(1).transpose() * x.v + gradient.col(2).transpose() * x.a +
           gradient.col(3).transpose() * x.p;
  };
  const double rate  = partial + along(tangents_->local_rates())[0];
  double       could = std::abs(partial);
  for (int part = 0; part < 3; ++part)
    could += (gradient.col(part).cwiseAbs().array() * largest_[part + 1].array()).sum();
  dt_                       = Eigen::RowVectorXd::Zero(dq_begin_.cols());
  constexpr double touching = 1e-6; // slope of a guard, of what the motion could give it
  if (!gradient.isZero(0.) && std::abs(rate) > touching * could)
    dt_ = along(tangents_->local_tangents()) / -rate;
  else if (!gradient.isZero(0.))
  {
    const ActiveGuard active = system_.events().guard(number);
    passage_.grazing.push_back(active.name + ", " + active.kind);
  }
}

void PeriodFlow::event(const Event &)
{
  if (!carries_ || !jumps_)
    return;
  jumps_ = false;
  tangents_->jump_tangents(before_, dt_);
}

/// A passage that is put back has zero for the multiplier of a free shift.
Eigen::VectorXcd multipliers_of(const MatrixXd &monodromy, const PeriodicProblem &problem)
{
  const Eigen::VectorXcd all = largest_first(GeneralEigenSolver(monodromy, WithVectors::no).eigenvalues());
  return all.head(all.size() - problem.free.cols());
}

} // namespace gestell::coupling
