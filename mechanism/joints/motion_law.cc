#include "mechanism/joints/motion_law.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

bool MotionLaw::next_corner(const double *, double &, std::string &) const
{
  return false;
}

bool MotionLaw::command(const std::string &, double, double *) const
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
constexpr double pi = 3.14159265358979323846;
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
  // Inside the stage that history names, smoothly continued; behind the last corner at rest.
  const auto   stage = std::size_t(history[passed]);
  const bool   ended = stage >= corners_.size();
  const double tau = ended ? corners_.back() : t - history[begin], s = tau / T, x = history[from];
  switch (family)
  {
  case Family::linear:
    return {x + v * (tau - 0.5 * tau * s), ended ? 0. : v * (1. - s), ended ? 0. : -v / T};
  case Family::cosine:
    return {x + 0.5 * v * (tau + T / pi * std::sin(pi * s)), ended ? 0. : 0.5 * v * (1. + std::cos(pi * s)),
            ended ? 0. : -0.5 * v * pi / T * std::sin(pi * s)};
  case Family::shaped:
    break;
  }
  PrescribedMotion motion{x + v * tau, v, 0.};
  const double     middle =
      ended ? tau : 0.5 * ((stage > 0 ? corners_[stage - 1] : 0.) + corners_[stage]); // tells which ramps act
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

bool BrakedMotion::next_corner(const double *history, double &t, std::string &name) const
{
  if (history[passed] < 0. || std::size_t(history[passed]) >= corners_.size())
    return false;
  const auto stage = std::size_t(history[passed]);
  t                = history[begin] + corners_[stage];
  name             = stage + 1 == corners_.size() ? "braking_ends" : "braking_corner";
  return true;
}

void BrakedMotion::pass_corner(double, double *history) const
{
  history[passed] += 1.;
}

bool BrakedMotion::command(const std::string &order, double t, double *history) const
{
  if (order != "brake")
    return false;
  if (history[passed] >= 0.)
    return true; // brakes already
  history[from]   = parameters_.speed * (t - history[begin]);
  history[begin]  = t;
  history[passed] = 0.;
  return true;
}

} // namespace gestell::mechanism
