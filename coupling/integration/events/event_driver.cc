#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/events/finite_state.h"
#include "coupling/integration/events/guard_rounding.h"
#include "coupling/integration/step/load_breakpoints.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/error_control.h"
#include "coupling/integration/system/resumable.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
/// share of a step at which guards are evaluated first: off the middle, where a symmetric curve would be missed
constexpr double off_middle = 0.38;

/// Accuracy of the instant of an event at t in a step of length h: far better than the errors of steps.
double resolution(double t, double h)
{
  return std::max(1e-11 * h, 4. * std::numeric_limits<double>::epsilon() * std::abs(t));
}
} // namespace

const std::vector<RunObserver *> &EventDriver::none()
{
  static const std::vector<RunObserver *> none;
  return none;
}

EventDriver::EventDriver(SecondOrderSystem &system, TimeIntegrator &integrator, const EventOptions &options,
                         const std::vector<RunObserver *> &observers)
    : system_(system), integrator_(integrator), options_(options), detection_(system), observers_(observers)
{
  before_.resize(system);
  between_.resize(system);
  make_room();
}

void EventDriver::make_room()
{
  const Eigen::Index room = system_.events().n_guards() + 4 * system_.forces().directions().cols() + 4;
  for (Eigen::VectorXd &g : g_)
    g.setZero(room);
  probe_.setZero(room);
}

void EventDriver::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  before_.t           = t;
  before_.u.noalias() = system_.forces().directions().transpose() * q;
  before_.v.noalias() = system_.forces().directions().transpose() * v;
  before_.a.setZero();
  before_.p.setZero();
  system_.events().follow_history(false);
  system_.events().start(before_);
  hold_what_is_still();
  auto *const  control  = dynamic_cast<ErrorControl *>(&integrator_);
  const bool   controls = control && control->controls_error();
  LoadedMotion loaded;
  if (controls)
    loaded = load_breakpoints(system_, before_, options_.end);
  system_.events().follow_history(options_.locate);
  integrator_.begin(t, q, v);
  if (controls)
    control->expect(loaded.way, loaded.speed);
  before_ = integrator_.local();
  detection_.begin(before_);
  anew_ = true;
  watched_.clear();
  window_begin_ = t;
  in_window_    = 0;
}

/// If the load exceeds the limit, the new branch slips at once in the direction of the load.
void EventDriver::hold_what_is_still()
{
  EventSystem &events = system_.events();
  int          left   = options_.still > 0. ? events.n_guards() : 0; // each measure once
  for (int i = 0; i < events.n_guards() && left > 0; ++i)
  {
    probe_.resize(std::max<Eigen::Index>(probe_.size(), events.n_guards()));
    events.guard_values(before_, probe_);
    if (events.guard(i).kind != "stick" || std::abs(probe_[i]) > options_.still)
      continue;
    events.transition(i, before_);
    --left;
    i = -1; // guards are others now
  }
}

void EventDriver::advance()
{
  if (!options_.locate)
  {
    step_over();
    tell_events();
    return;
  }
  make_step(integrator_, system_);
  const double full = integrator_.time() - integrator_.step_begin();
  if (integrator_.time() - window_begin_ > length_ + full)
  {
    window_begin_ = integrator_.step_begin();
    in_window_    = 0;
  }
  length_ = full;
  if (!cut_at_end())
    return;

  Crossing crossing;
  if (!first_crossing(crossing))
  {
    observe();
    system_.events().accept(integrator_.local());
    before_ = integrator_.local();
    anew_   = false;
    return;
  }
  take(crossing);
  tell_events();
  if (++in_window_ > options_.max_per_step && integrator_.time() < options_.end)
  {
    ++chattering_;
    in_window_ = 0;
    system_.events().follow_history(false);
    detection_.begin(integrator_.local());
    step_over();
    chattering_time_ += integrator_.time() - before_.t;
    system_.events().follow_history(true);
    integrator_.restart();
    before_ = integrator_.local();
    tell_events();
  }
}

/// A step with all laws following the motion; its events are found afterwards.
void EventDriver::step_over()
{
  before_ = integrator_.local();
  make_step(integrator_, system_);
  if (!cut_at_end())
    return;
  observe();
  detection_.step(before_, integrator_.local(), events_);
  system_.events().accept(integrator_.local());
  anew_ = false;
}

/// Cuts the last step at the end of the run. Returns false if the integrator rejected the step instead, and continues
/// from its start with a smaller one.
bool EventDriver::cut_at_end()
{
  if (!(integrator_.time() > options_.end))
    return true;
  integrator_.cut(options_.end);
  if (integrator_.time() == options_.end)
    return true;
  integrator_.restart();
  before_ = integrator_.local();
  return false;
}

void EventDriver::observe()
{
  for (RunObserver *observer : observers_)
    observer->step();
}

void EventDriver::tell_events()
{
  for (; reported_ < events_.size(); ++reported_)
    for (RunObserver *observer : observers_)
      observer->event(events_[reported_]);
}

double EventDriver::value_at(int guard, double t)
{
  integrator_.interpolate(t, between_);
  system_.events().guard_values(between_, probe_);
  return sign(guard) * probe_[guard];
}

/// Illinois' variant of regula falsi on the dense output; ends just past the zero.
void EventDriver::locate(int guard, double low, double g_low, double high, double g_high, Crossing &crossing)
{
  const double finest = resolution(high, high - low);
  int          side   = 0;
  double       f_low = g_low, f_high = g_high, width = high - low;
  for (int k = 0; k < 60 && high - low > finest && f_high > 0.; ++k)
  {
    double t = f_high - f_low > 0. ? (low * f_high - high * f_low) / (f_high - f_low) : 0.5 * (low + high);
    if (!(t > low && t < high) || k % 8 == 7)
      t = 0.5 * (low + high);
    const double g    = value_at(guard, t);
    const bool   wide = high - low > 1e-3 * width; // below, the slope would be rounding
    if (g < 0.)
    {
      if (wide)
        crossing.slope = (g_high - g) / (high - t);
      low = t, f_low = g_low = g;
      if (side == -1)
        f_high *= 0.5;
      side = -1;
    }
    else
    {
      if (wide)
        crossing.slope = (g - g_low) / (t - low);
      high = t, f_high = g_high = g;
      if (side == 1)
        f_low *= 0.5;
      side = 1;
    }
  }
  crossing.guard = guard;
  crossing.t     = high;
}

/// Whether start, end and one instant between them show that no guard is near zero: the distance of the parabola
/// through them is more than twice its variation, with the curvature weighted sixfold.  The instant is not the middle,
/// where a rise in one half and a fall in the other would be missed: c s (s - 1/2) (s - 1) is at most 1.7 times that.
bool EventDriver::far_from_zero() const
{
  for (int i = 0; i < system_.events().n_guards(); ++i)
  {
    const double s = sign(i), begin = s * g_[0][i], inside = s * probe_[i], end = s * g_[n_inside + 1][i];
    const double way = std::abs(end - begin) + 6. * std::abs(inside - begin - off_middle * (end - begin));
    if (!(std::max({begin, inside, end}) < -2. * way))
      return false;
  }
  return true;
}

/// Finds the first crossing; searches the step in parts if the phase of the motion advances far within it.
bool EventDriver::first_crossing(Crossing &first)
{
  const int n = system_.events().n_guards();
  if (n == 0)
    return false;
  if (n > probe_.size())
    make_room();
  const double begin = integrator_.step_begin(), end = integrator_.time();
  const int    parts = integrator_.parts_of_step();
  const auto   at    = [&](int k) { return k == parts ? end : begin + (end - begin) * k / parts; };
  for (int k = 0; k < parts; ++k)
    if (first_crossing_between(at(k), at(k + 1), first))
      return true;
  return false;
}

bool EventDriver::first_crossing_between(double begin, double end, Crossing &first)
{
  const int     n    = system_.events().n_guards();
  constexpr int last = n_inside + 1;
  double        t[last + 1];
  for (int k = 0; k <= last; ++k)
    t[k] = k == last ? end : begin + (end - begin) * k / last;
  const auto sample = [&](int k)
  {
    integrator_.interpolate(t[k], between_);
    system_.events().guard_values(between_, g_[k]);
  };
  if (begin == integrator_.step_begin())
    system_.events().guard_values(before_, g_[0]);
  else
    sample(0);
  if (end == integrator_.time())
    system_.events().guard_values(integrator_.local(), g_[last]);
  else
    sample(last);
  integrator_.interpolate(begin + off_middle * (end - begin), between_);
  system_.events().guard_values(between_, probe_);
  if (far_from_zero())
    return false;
  for (int k = 1; k < last; ++k)
    sample(k);

  first.t = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i)
  {
    const auto look     = [&](int k) { return Look{t[k], sign(i) * g_[k][i]}; };
    const auto is_event = [&]
    {
      const bool again = !events_.empty() && events_.back().name == system_.events().guard(i).name;
      return !again || !is_rounding(system_, integrator_, i, before_, g_);
    };
    const bool past = begin == integrator_.step_begin() && begins_past(i, look(0).g);
    if (first.t > begin && (past || is_due_at_begin(i, look(0).g, look(1).g)) && is_event())
      first = {i, begin, 0.};
    for (int k = 0; k < last && t[k] < first.t; ++k)
    {
      const Look here = look(k), next = look(k + 1);
      Look       low = here, high = next;
      const bool crosses = here.g < 0. && next.g >= 0. && (next.g > 0. || k + 1 < last);
      if (!crosses && !(k > 0 && turns_above_zero(i, look(k - 1), here, next, low, high)))
        continue;
      Crossing crossing;
      crossing.slope = (high.g - low.g) / (high.t - low.t);
      locate(i, low.t, low.g, high.t, high.g, crossing);
      if (crossing.t < first.t && is_event())
        first = crossing;
      break;
    }
  }
  return first.guard >= 0;
}

/// Past zero at the start of a step.  After a transition rounding may leave the reverse guard there; the force of a
/// sticking measure is known at once, and a value that would return to the limit immediately is rounding.
bool EventDriver::is_due_at_begin(int guard, double here, double next)
{
  constexpr double no_time = 1e-3; // of the way to the next look: what moves by then is a part in 10^9
  return (here >= 0. && next > 0.) || (here > no_time * (here - next) && here > 0. && looks_at_held_force(guard));
}

/// At the start of a step: a new guard is past its zero by more than rounding.  Not for an object that has just changed
/// its branch, which may be past zero by the accuracy of its event, or of its rate.
bool EventDriver::begins_past(int guard, double here)
{
  if (!anew_ || !(here > 0.) || std::count(watched_.begin(), watched_.end(), system_.events().guard(guard).name) > 0)
    return false;
  return here > guard_rounding(system_, integrator_, guard, before_);
}

/// At the start of a step: whether the guard depends on forces of sticking measures.
bool EventDriver::looks_at_held_force(int guard)
{
  if (system_.forces().held().empty())
    return false;
  between_ = before_;
  for (const HeldMeasure &h : system_.forces().held())
    between_.p[h.measure] = 0.;
  system_.events().guard_values(between_, probe_);
  return probe_[guard] != g_[0][guard];
}

/// Whether a guard that is negative at three instants has a maximum above zero by more than rounding: `top` there,
/// `low` before it.  Parabolas approximate the maximum until their vertex is far below zero compared with their error.
bool EventDriver::turns_above_zero(int guard, Look a, Look b, Look c, Look &low, Look &top)
{
  constexpr double err = 0.1; // of the rise within a parabola: a sine bends its peak by 3 % at 0.8 rad between looks
  if (!(a.g < 0. && b.g < 0. && c.g < 0.))
    return false;
  for (int k = 0; k < 8; ++k)
  {
    const double     rise = (b.g - a.g) / (b.t - a.t), curvature = ((c.g - b.g) / (c.t - b.t) - rise) / (c.t - a.t);
    double           t      = 0.5 * (a.t + b.t) - 0.5 * rise / curvature;
    constexpr double nearby = 0.25; // share of its length by which a parabola errs for a maximum at its end
    if (!(curvature < 0. && t > a.t - nearby * (c.t - a.t) && t < c.t + nearby * (c.t - a.t)))
      return false;
    const double vertex = a.g + (t - a.t) * (rise + curvature * (t - b.t));
    const double way    = std::max({a.g, b.g, c.g, vertex}) - std::min({a.g, b.g, c.g});
    if (vertex < -err * way || t == b.t)
      return false;
    // A maximum that seems to be outside is searched at the end, from inside.
    if (t >= c.t)
      t = 0.25 * b.t + 0.75 * c.t;
    else if (t <= a.t)
      t = 0.25 * b.t + 0.75 * a.t;
    const Look seen{t, value_at(guard, t)};
    if (seen.g > 0.)
    {
      low                   = t > b.t ? b : a;
      top                   = seen;
      const double rounding = guard_rounding(system_, integrator_, guard, before_, c.t - a.t);
      return !(std::isfinite(rounding) && seen.g <= rounding); // at the start, where a transition left it
    }
    // The highest of the four is kept with its neighbours.
    Look four[] = {a, b, c, seen};
    std::sort(four, four + 4, [](const Look &x, const Look &y) { return x.t < y.t; });
    const auto highest =
        std::max_element(four, four + 4, [](const Look &x, const Look &y) { return x.g < y.g; }) - four;
    const Look *middle = four + std::clamp<std::ptrdiff_t>(highest, 1, 2);
    a = middle[-1], b = middle[0], c = middle[1];
  }
  return false;
}

void EventDriver::take(const Crossing &crossing)
{
  const int        guard = crossing.guard;
  const double     begin = integrator_.step_begin(), end = integrator_.time();
  const double     finest   = resolution(end, end - begin);
  constexpr double a_little = 0.1; // share of a step by which the force of a sticking measure errs in time
  const double     most     = looks_at_held_force(guard) ? a_little * (end - begin) : end - begin;
  double           t        = crossing.t;
  integrator_.cut(t);
  // The state at the cut may be better than the dense output: move the cut until its own guard is zero.
  double slope = crossing.slope, t_last = t, g_last = 0.;
  for (int k = 0; k < 6 && t > begin; ++k)
  {
    system_.events().guard_values(integrator_.local(), probe_);
    const double g = sign(guard) * probe_[guard];
    if (k > 0 && t != t_last)
      slope = (g - g_last) / (t - t_last);
    const double next = slope > 0. ? std::clamp(t - g / slope, begin, end) : t;
    if (std::abs(next - t) <= finest || std::abs(next - crossing.t) > most)
      break;
    t_last = t, g_last = g, t = next;
    integrator_.cut(t);
  }
  if (integrator_.time() < t)
  {
    integrator_.restart(); // the integrator rejected the step: it continues from its start with a smaller one
    before_ = integrator_.local();
    return;
  }
  observe();
  for (RunObserver *observer : observers_)
    observer->guard(guard);
  const ActiveGuard active = system_.events().guard(guard);
  if (integrator_.time() > begin)
    watched_ = guard_owners(system_.events());
  watched_.push_back(active.name);
  anew_ = true;
  events_.push_back({integrator_.time(), active.name, active.kind});
  between_ = integrator_.local();
  system_.events().accept(between_);
  system_.events().transition(guard, between_);
  integrator_.restart();
  before_ = integrator_.local();
}

void exchange(StateArchive &archive, Event &event)
{
  archive(event.t, event.name, event.kind);
}

void EventDriver::exchange(StateArchive &archive)
{
  Eigen::VectorXd history = system_.events().save_history();
  archive(history);
  if (archive.reads())
    system_.events().restore_history(history);
  if (auto *const resumable = dynamic_cast<Resumable *>(&integrator_))
    resumable->exchange(archive);
  if (archive.reads())
    detection_.begin(integrator_.local());
  archive(events_, before_, between_, g_, probe_, window_begin_, length_, in_window_, chattering_, chattering_time_,
          reported_, anew_, watched_);
}

} // namespace gestell::coupling
