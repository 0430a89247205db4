#include "coupling/integration/events/event_detection.h"

namespace gestell::coupling
{

EventDetection::EventDetection(SecondOrderSystem &system) : system_(system)
{
  make_room();
}

void EventDetection::make_room()
{
  const Eigen::Index room = system_.events().n_guards() + 4 * system_.forces().directions().cols() + 4;
  g_from_.setZero(room);
  g_to_.setZero(room);
  g_.setZero(room);
}

void EventDetection::begin(const LocalState &state)
{
  between_ = state;
  if (system_.events().n_guards() > g_.size())
    make_room();
  system_.events().guard_values(state, g_from_);
}

// Cubic Hermite interpolation of u and the derivative of that cubic as u'.
void EventDetection::at(const LocalState &from, const LocalState &to, double s, LocalState &state) const
{
  const double h = to.t - from.t, r = 1. - s;
  state.t = from.t + s * h;
  state.u = ((1. + 2. * s) * r * r) * from.u + (s * s * (3. - 2. * s)) * to.u + (h * s * r * r) * from.v -
            (h * s * s * r) * to.v;
  state.v      = (6. * s * r / h) * (to.u - from.u) + (r * (1. - 3. * s)) * from.v + (s * (3. * s - 2.)) * to.v;
  state.a      = r * from.a + s * to.a;
  state.p      = r * from.p + s * to.p;
  state.lambda = r * from.lambda + s * to.lambda;
}

double EventDetection::value(int guard, const LocalState &from, const LocalState &to, double share)
{
  at(from, to, share, between_);
  system_.events().guard_values(between_, g_);
  return g_[guard];
}

bool EventDetection::earliest(const LocalState &from, const LocalState &to, double since, int &guard, double &share)
{
  bool found = false;
  for (int i = 0; i < system_.events().n_guards(); ++i)
  {
    const double sign  = system_.events().crossing(i) == GuardCrossing::rising ? 1. : -1.;
    const double begin = sign * g_from_[i], end = sign * g_to_[i];
    if (end < 0. || (end == 0. && begin >= 0.))
      continue;
    double low = since, high = begin < 0. ? 1. : since;
    if (begin < 0.)
      for (int k = 0; k < 60 && high - low > 1e-12; ++k)
      {
        const double middle                                   = 0.5 * (low + high);
        (sign * value(i, from, to, middle) < 0. ? low : high) = middle;
      }
    if (!found || high < share)
    {
      found = true;
      guard = i;
      share = high;
    }
  }
  return found;
}

void EventDetection::step(const LocalState &from, const LocalState &to, std::vector<Event> &events)
{
  system_.events().guard_values(to, g_to_);
  double since = 0., share = 1.;
  int    guard = 0;
  for (int count = 0; earliest(from, to, since, guard, share); ++count)
  {
    if (count == max_per_step)
    {
      ++chattering_;
      break;
    }
    at(from, to, share, between_);
    const ActiveGuard active = system_.events().guard(guard);
    events.push_back({between_.t, active.name, active.kind});
    system_.events().transition(guard, between_);
    since = share;
    system_.events().guard_values(between_, g_from_);
    system_.events().guard_values(to, g_to_);
  }
  g_from_.swap(g_to_);
}

} // namespace gestell::coupling
