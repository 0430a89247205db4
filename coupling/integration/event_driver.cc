#include "coupling/integration/event_driver.h"

#include "coupling/integration/error_control.h"
#include "coupling/integration/loads_to_come.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
constexpr double off_middle = 0.38; ///< share of a step where guards are looked at first

/// To what an event at t in a step of length h is located: far below what any step's error does to its time.
double resolution(double t, double h)
{
  return std::max(1e-11 * h, 4. * std::numeric_limits<double>::epsilon() * std::abs(t));
}
} // namespace

EventDriver::EventDriver(SecondOrderSystem &system, TimeIntegrator &integrator, const EventOptions &options)
    : system_(system), integrator_(integrator), options_(options), detection_(system)
{
  before_.resize(system);
  between_.resize(system);
  make_room();
}

void EventDriver::make_room()
{
  const Eigen::Index room = system_.n_guards() + 4 * system_.directions().cols() + 4;
  for (Eigen::VectorXd &g : g_)
    g.setZero(room);
  probe_.setZero(room);
}

void EventDriver::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  before_.t           = t;
  before_.u.noalias() = system_.directions().transpose() * q;
  before_.v.noalias() = system_.directions().transpose() * v;
  before_.a.setZero();
  before_.p.setZero();
  system_.follow_history(false);
  system_.start(before_);
  auto *const  control  = dynamic_cast<ErrorControl *>(&integrator_);
  const bool   controls = control && control->controls_error();
  LoadedMotion loaded;
  if (controls)
    loaded = loads_to_come(system_, before_, options_.end);
  system_.follow_history(options_.locate);
  integrator_.begin(t, q, v);
  if (controls)
    control->expect(loaded.way, loaded.speed);
  before_ = integrator_.local();
  detection_.begin(before_);
  window_begin_ = t;
  in_window_    = 0;
}

void EventDriver::advance()
{
  if (!options_.locate)
  {
    step_over();
    return;
  }
  integrator_.advance();
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
    system_.accept(integrator_.local());
    before_ = integrator_.local();
    return;
  }
  take(crossing);
  if (++in_window_ > options_.max_per_step && integrator_.time() < options_.end)
  {
    ++chattering_;
    in_window_ = 0;
    system_.follow_history(false);
    detection_.begin(integrator_.local());
    step_over();
    system_.follow_history(true);
    integrator_.restart();
    before_ = integrator_.local();
  }
}

/// A step with all laws following the motion; its events are found afterwards.
void EventDriver::step_over()
{
  before_ = integrator_.local();
  integrator_.advance();
  if (!cut_at_end())
    return;
  observe();
  detection_.step(before_, integrator_.local(), events_);
  system_.accept(integrator_.local());
}

/// False: the integrator gave the step up instead; it goes on from its begin with a smaller one.
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

void EventDriver::observe() const
{
  if (observer_)
    observer_();
}

double EventDriver::value_at(int guard, double t)
{
  integrator_.interpolate(t, between_);
  system_.guard_values(between_, probe_);
  return sign(guard) * probe_[guard];
}

/// Illinois' variant of regula falsi on the dense output; ends just past the zero.
void EventDriver::locate(int guard, double low, double g_low, double high, double g_high, Crossing &crossing)
{
  const double finest = resolution(high, high - low);
  const double width  = high - low;
  int          side   = 0;
  double       f_low = g_low, f_high = g_high;
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

/// Begin, end and one instant between them tell that no guard comes near zero: the parabola through them stays away by
/// more than twice what it moves, the part that bends counted sixfold.  That instant is not the middle, where a rise in
/// one half and a fall in the other would hide: c s (s - 1/2) (s - 1) is nowhere larger than 1.7 times there.
bool EventDriver::far_from_zero() const
{
  for (int i = 0; i < system_.n_guards(); ++i)
  {
    const double s = sign(i), begin = s * g_[0][i], inside = s * probe_[i], end = s * g_[n_inside + 1][i];
    const double way = std::abs(end - begin) + 6. * std::abs(inside - begin - off_middle * (end - begin));
    if (!(std::max({begin, inside, end}) < -2. * way))
      return false;
  }
  return true;
}

bool EventDriver::first_crossing(Crossing &first)
{
  const int n = system_.n_guards();
  if (n == 0)
    return false;
  if (n > probe_.size())
    make_room();
  const double  begin = integrator_.step_begin(), end = integrator_.time();
  constexpr int last = n_inside + 1;
  double        t[last + 1];
  for (int k = 0; k <= last; ++k)
    t[k] = k == last ? end : begin + (end - begin) * k / last;
  const auto sample = [&](int k)
  {
    integrator_.interpolate(t[k], between_);
    system_.guard_values(between_, g_[k]);
  };
  system_.guard_values(before_, g_[0]);
  system_.guard_values(integrator_.local(), g_[last]);
  integrator_.interpolate(begin + off_middle * (end - begin), between_);
  system_.guard_values(between_, probe_);
  if (far_from_zero())
    return false;
  for (int k = 1; k < last; ++k)
    sample(k);

  first.t = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i)
  {
    const double s = sign(i);
    for (int k = 0; k < last && t[k] < first.t; ++k)
    {
      const double here = s * g_[k][i], next = s * g_[k + 1][i];
      if (here >= 0. && next > 0. && k == 0)
      {
        first = {i, begin, 0.};
        break;
      }
      if (here < 0. && next >= 0. && (next > 0. || k + 1 < last))
      {
        Crossing crossing;
        crossing.slope = (next - here) / (t[k + 1] - t[k]);
        locate(i, t[k], here, t[k + 1], next, crossing);
        if (crossing.t < first.t)
          first = crossing;
        break;
      }
      if (k == 0)
        continue;
      // A guard that touches zero between samples: the vertex of the parabola through three of them.
      const double left = s * g_[k - 1][i], curvature = left - 2. * here + next;
      if (left < 0. && here < 0. && next < 0. && curvature < 0.)
      {
        const double shift = 0.5 * (left - next) / curvature;
        if (std::abs(shift) < 1. && here - 0.5 * curvature * shift * shift > 0.)
        {
          const double vertex = t[k] + shift * (t[k + 1] - t[k]), top = value_at(i, vertex);
          if (top > 0.)
          {
            const int from = shift < 0. ? k - 1 : k;
            Crossing  crossing;
            locate(i, t[from], s * g_[from][i], vertex, top, crossing);
            if (crossing.t < first.t)
              first = crossing;
            break;
          }
        }
      }
    }
  }
  return first.guard >= 0;
}

void EventDriver::take(const Crossing &crossing)
{
  const int    guard = crossing.guard;
  const double begin = integrator_.step_begin(), end = integrator_.time();
  double       t = crossing.t;
  integrator_.cut(t);
  // The state at the cut may be better than the dense output: move the cut until its own guard is zero.
  const double finest = resolution(end, end - begin);
  double       slope = crossing.slope, t_last = t, g_last = 0.;
  for (int k = 0; k < 6 && t > begin; ++k)
  {
    system_.guard_values(integrator_.local(), probe_);
    const double g = sign(guard) * probe_[guard];
    if (k > 0 && t != t_last)
      slope = (g - g_last) / (t - t_last);
    const double next = slope > 0. ? std::clamp(t - g / slope, begin, end) : t;
    if (std::abs(next - t) <= finest)
      break;
    t_last = t, g_last = g, t = next;
    integrator_.cut(t);
  }
  if (integrator_.time() < t)
  {
    integrator_.restart(); // the integrator gave the step up: it goes on from its begin with a smaller one
    before_ = integrator_.local();
    return;
  }
  observe();
  const ActiveGuard active = system_.guard(guard);
  events_.push_back({integrator_.time(), active.name, active.kind});
  between_ = integrator_.local();
  system_.accept(between_);
  system_.transition(guard, between_);
  integrator_.restart();
  before_ = integrator_.local();
}

} // namespace gestell::coupling
