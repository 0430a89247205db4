#include "mechanism/joints/motion_law.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::mechanism
{

bool MotionLaw::command(const SwitchCommand &, double, double *) const
{
  return false;
}

namespace
{
enum Slot
{
  passed, ///< -1 before the order
  begin,
  from
};
} // namespace

BrakedMotion::BrakedMotion(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[speed, family, T, ramps] = parameters_;
  require(T > 0., "braked motion", "duration [s]", T, "positive");
  if (family != Family::shaped)
  {
    corners_ = {T};
    return;
  }
  double sum = 0.;
  for (const Ramp &part : ramps)
  {
    require(part.delay >= 0., "braked motion", "delay of a ramp [s]", part.delay, "zero or positive");
    sum += part.share;
    for (const double corner : {part.delay, part.delay + T})
      if (corner > 0.)
        corners_.push_back(corner);
  }
  require(std::abs(sum - 1.) < 1e-9, "braked motion", "sum of the shares of its ramps", sum, "1");
  std::sort(corners_.begin(), corners_.end());
  const double same = 1e-12 * corners_.back();
  corners_.erase(
      std::unique(corners_.begin(), corners_.end(), [same](double a, double b) { return std::abs(a - b) <= same; }),
      corners_.end());
}

void BrakedMotion::start(double t, double *history) const
{
  history[passed] = -1.;
  history[begin]  = t;
  history[from]   = 0.;
}

PrescribedMotion BrakedMotion::at(double t, const double *history) const
{
  const auto &[v, family, T, ramps] = parameters_;
  if (history[passed] < 0.)
    return {v * (t - history[begin]), v, 0.};
  // Smooth continuation of the stage in `history`; at rest after the last corner.
  const auto   stage = std::size_t(history[passed]);
  const bool   ended = stage >= corners_.size();
  const double tau = ended ? corners_.back() : t - history[begin], s = tau / T, x = history[from];
  switch (family)
  {
  case Family::linear:
    return {x + v * (tau - 0.5 * tau * s), ended ? 0. : v * (1. - s), ended ? 0. : -v / T};
  case Family::cosine:
    return {x + 0.5 * v * (tau + T / M_PI * std::sin(M_PI * s)), ended ? 0. : 0.5 * v * (1. + std::cos(M_PI * s)),
            ended ? 0. : -0.5 * v * M_PI / T * std::sin(M_PI * s)};
  case Family::shaped:
    break;
  }
  PrescribedMotion motion{x + v * tau, v, 0.};
  const double     middle =
      ended ? tau : 0.5 * ((stage > 0 ? corners_[stage - 1] : 0.) + corners_[stage]); // determines the active ramps
  for (const Ramp &part : ramps)
  {
    const double at = (tau - part.delay) / T, now = (middle - part.delay) / T;
    if (now <= 0.)
      continue;
    const bool   acts  = now < 1.;
    const double share = v * part.share;
    motion.value -= share * T * (acts ? 0.5 * at * at : at - 0.5);
    motion.rate -= share * (acts ? at : 1.);
    motion.acceleration -= acts ? share / T : 0.;
  }
  if (ended)
    motion.rate = motion.acceleration = 0.;
  return motion;
}

bool BrakedMotion::brakes(const double *history) const
{
  return history[passed] >= 0. && std::size_t(history[passed]) < corners_.size();
}

std::vector<Guard> BrakedMotion::guards(const double *history) const
{
  if (!brakes(history))
    return {};
  const bool last = std::size_t(history[passed]) + 1 == corners_.size();
  return {{last ? "braking_ends" : "braking_corner", Crossing::rising}};
}

void BrakedMotion::guard_values(double t, const double *history, double *g) const
{
  if (brakes(history))
    g[0] = t - (history[begin] + corners_[std::size_t(history[passed])]);
}

void BrakedMotion::transition(int, double, double *history) const
{
  history[passed] += 1.;
}

bool BrakedMotion::command(const SwitchCommand &order, double t, double *history) const
{
  if (order.name != "brake")
    return false;
  if (history[passed] >= 0.)
    return true; // brakes already
  history[from]   = parameters_.speed * (t - history[begin]);
  history[begin]  = t;
  history[passed] = 0.;
  return true;
}

void BrakedMotion::check_order(const SwitchCommand &order) const
{
  if (std::isfinite(order.rate) || std::isfinite(order.rate_of_rate))
    throw std::invalid_argument("braked motion: the command \"" + order.name +
                                "\" allows neither an acceleration nor a jerk, because the key 'brake' of the motion "
                                "defines them; remove them, or this key");
}

// --- a profile of the speed

ProfileMotion::ProfileMotion(const CommandedProfile &speed) : speed_(speed)
{
  const Profile &profile = speed_.profile();
  double         largest = 0.;
  for (const double level : speed_.levels())
    largest = std::max(largest, std::abs(level));
  for (std::size_t piece = 0; profile.ends(piece); ++piece)
  {
    const double t = profile.corner(piece), before = profile.value(piece, t), after = profile.value(piece + 1, t);
    require(std::abs(after - before) <= 1e-9 * largest, "prescribed motion", "jump of the speed", after - before,
            "zero; limit the 'acceleration' of its ramps, because a jump of the speed needs an infinite force");
  }
  if (speed_.waits())
  {
    std::vector<double> history(speed_.n_history());
    speed_.start(0., history.data());
    const double before = speed_.at(0., true, history.data()).value, after = profile.value(profile.piece_at(0.), 0.);
    require(std::abs(after - before) <= 1e-9 * largest, "prescribed motion", "jump of the speed at its start",
            after - before, "zero; add ramps with limited 'acceleration' from the initial speed");
  }
}

void ProfileMotion::start(double t, double *history) const
{
  speed_.start(t, history + 1);
  history[0] = -speed_.integral(t, history + 1);
}

PrescribedMotion ProfileMotion::at(double t, const double *history) const
{
  const auto speed = speed_.at(t, true, history + 1);
  return {history[0] + speed_.integral(t, history + 1), speed.value, speed.rate};
}

void ProfileMotion::guard_values(double t, const double *history, double *g) const
{
  speed_.guard_values(t, history + 1, g);
}

void ProfileMotion::transition(int i, double t, double *history) const
{
  speed_.transition(i, t, history + 1);
}

bool ProfileMotion::command(const SwitchCommand &order, double t, double *history) const
{
  const double now = history[0] + speed_.integral(t, history + 1);
  if (!speed_.command(order, t, history + 1))
    return false;
  history[0] = now - speed_.integral(t, history + 1);
  return true;
}

std::vector<std::string> ProfileMotion::commands() const
{
  auto orders = CommandedProfile::commands();
  if (!speed_.waits()) // its speed would jump
    orders.erase(std::find(orders.begin(), orders.end(), "start"));
  return orders;
}

void ProfileMotion::check_order(const SwitchCommand &order) const
{
  if ((order.name == "set" || order.name == "brake") && !std::isfinite(order.rate))
    throw std::invalid_argument("prescribed motion: the command \"" + order.name +
                                "\" needs an 'acceleration', because a jump of the speed needs an infinite force");
}

} // namespace gestell::mechanism
