#include "coupling/simulation/checks/step_resolution_check.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/fastest_load.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::ArrayXd;
using Eigen::VectorXd;

/// below it a note is printed: linear interpolation misses 5 % of a sine with ten points
constexpr double  steps_of_period = 10.;
constexpr double  negligible      = 1e-9; ///< R, of the largest force: rounding
const char *const resolution      = "step-resolution";

template <typename... Parts>
std::string words(const Parts &...parts)
{
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

/// Statistics of each force from the samples of steps.
class Looks
{
public:
  explicit Looks(Eigen::Index n)
      : low_(ArrayXd::Constant(n, INFINITY)), high_(-low_), seen_low_(low_), seen_high_(high_), differ_(n, 0)
  {
  }

  void end(const VectorXd &p)
  {
    seen_low_  = seen_low_.min(p.array());
    seen_high_ = seen_high_.max(p.array());
    between(p);
  }
  void between(const VectorXd &p)
  {
    low_  = low_.min(p.array());
    high_ = high_.max(p.array());
  }
  /// Second pass over the same steps, when ranges are known.
  void compare(const ArrayXd &largest_difference)
  {
    constexpr double differs = 1. / 40.; // D of R: 2.4 % at ten steps a period
    for (Eigen::Index i = 0; i < low_.size(); ++i)
      differ_[std::size_t(i)] += largest_difference[i] > differs * range(i);
  }

  bool any_above(double least) const
  {
    for (Eigen::Index i = 0; i < low_.size(); ++i)
      if (range(i) > least)
        return true;
    return false;
  }

  double range(Eigen::Index i) const { return high_[i] - low_[i]; }
  double seen_range(Eigen::Index i) const { return seen_high_[i] - seen_low_[i]; }
  int    n_differing(Eigen::Index i) const { return differ_[std::size_t(i)]; }
  /// Largest of the finite ones.
  double largest() const
  {
    double largest = 0.;
    for (Eigen::Index i = 0; i < low_.size(); ++i)
      if (const double size = std::max(std::abs(low_[i]), std::abs(high_[i])); std::isfinite(size))
        largest = std::max(largest, size);
    return largest;
  }

private:
  ArrayXd          low_, high_, seen_low_, seen_high_;
  std::vector<int> differ_;
};

/// Steps spread over the run.
struct Steps
{
  double begin, h, number, looked_at;

  double operator[](int k) const { return begin + h * std::floor(k * number / looked_at); } ///< start of a step [s]
  int    size() const { return int(looked_at); }
};

Steps steps_of(double begin, double end, double h, Eigen::Index n)
{
  const double     number     = std::max(1., std::floor((end - begin) / h));
  constexpr double most_looks = 5000., least_looks = 200., most_forces = 1e6; // evaluated at the looks
  return {begin, h, number, std::min(number, std::clamp(most_forces / double(n), least_looks, most_looks))};
}

/// Forces for a constant motion, at any time.
class AtTime
{
public:
  AtTime(const LocalForces &forces, const LocalState &state)
      : forces_(forces), state_(state), p_(VectorXd::Zero(state.u.size())) // laws of sticking measures write nothing
  {
  }

  const VectorXd &operator()(double t)
  {
    state_.t = t;
    forces_.force(state_, p_);
    return p_;
  }

private:
  const LocalForces &forces_;
  LocalState         state_;
  VectorXd           p_;
};

/// First pass with the middle of steps: most forces do not depend explicitly on time.
bool depend_on_time(AtTime &at, const Steps &steps, Eigen::Index n)
{
  Looks looks(n);
  for (int k = 0; k < steps.size(); ++k)
  {
    looks.between(at(steps[k]));
    looks.between(at(steps[k] + 0.5 * steps.h));
  }
  return looks.any_above(negligible * looks.largest());
}

void add_of_time(const LocalForces &forces, const LocalState &state, double begin, double h, RunOutcome &outcome)
{
  const Eigen::Index n     = state.u.size();
  const Steps        steps = steps_of(begin, state.t, h, n);
  AtTime             at(forces, state);
  if (!depend_on_time(at, steps, n))
    return;
  Looks            looks(n);
  constexpr double inside[] = {0.25, 0.5, 0.75};
  for (int k = 0; k < steps.size(); ++k)
  {
    looks.end(at(steps[k]));
    for (const double part : inside)
      looks.between(at(steps[k] + part * h));
    looks.end(at(steps[k] + h));
  }
  VectorXd first(n), last(n);
  ArrayXd  difference(n);
  for (int k = 0; k < steps.size(); ++k)
  {
    first = at(steps[k]);
    last  = at(steps[k] + h);
    difference.setZero();
    for (const double part : inside)
      difference = difference.max((at(steps[k] + part * h) - (1. - part) * first - part * last).array().abs());
    looks.compare(difference);
  }
  const double  least = negligible * looks.largest();
  std::string   before;
  int           n_named    = 0;
  constexpr int most_named = 3; // forces, a message each
  for (Eigen::Index i = 0; i < n && n_named < most_named; ++i)
  {
    constexpr double seen   = 0.5; // share of R: the other half is between the ends of steps
    const bool       hidden = looks.seen_range(i) < seen * looks.range(i);
    constexpr double often  = 0.25; // share of the steps: kinks and shocks take fewer
    if (!(looks.range(i) > least) || !(hidden || looks.n_differing(i) > often * steps.size()))
      continue;
    const std::string element = forces.element_of(int(i));
    if (element == before)
      continue;
    before = element;
    ++n_named;
    outcome.warn(resolution, element,
                 words("run.step: the force of ", element,
                       hidden ? " acts mainly between the ends of steps"
                              : " changes too fast for the steps (fewer than about ten per period)",
                       ", so it is not resolved. Use much shorter steps than ", h,
                       " s, until results no longer change"));
  }
}

void add_of_loads(const Machine &machine, double h, RunOutcome &outcome)
{
  const double omega = fastest_load(machine.linear().excitation());
  if (h * omega > 2. * M_PI / steps_of_period)
    outcome.warn(resolution, "run.step",
                 words("run.step: ", 2. * M_PI / (h * omega), " steps in a period of the load of ", omega / (2. * M_PI),
                       " Hz; use at most a twentieth of that period, ", 2. * M_PI / omega / 20., " s"));
}

/// The first force that changes with the angle of a body and is equal after a revolution: one that is not depends on
/// another angle too, such as that of a shaft between two rotors.  -1: none.
Eigen::Index turning_with(const LocalForces &forces, const LocalState &last, int coordinate)
{
  constexpr int  looks = 16; // per revolution: resolves forces with up to seven teeth
  const VectorXd turn  = forces.directions().row(coordinate).transpose();
  LocalState     state = last;
  VectorXd       p     = VectorXd::Zero(last.u.size()), first;
  Looks          seen_forces(last.u.size());
  for (int k = 0; k <= looks; ++k)
  {
    state.u = last.u + turn * (2. * M_PI * k / looks);
    forces.force(state, p);
    seen_forces.between(p);
    if (k == 0)
      first = p;
  }
  const double     least = negligible * seen_forces.largest();
  constexpr double same  = 1e-6; // difference of forces before and after a revolution, relative to their range
  for (Eigen::Index i = 0; i < p.size(); ++i)
    if (seen_forces.range(i) > least && std::abs(p[i] - first[i]) <= same * seen_forces.range(i))
      return i;
  return -1;
}

void add_of_turning(const Machine &machine, const LocalState &last, const VectorXd &v, double h, RunOutcome &outcome)
{
  for (const Body &body : machine.model().bodies())
  {
    if (body.kind != BodyKind::rotor || !(std::abs(v[body.coordinate]) * h > 2. * M_PI / steps_of_period))
      continue;
    if (const Eigen::Index i = turning_with(machine.forces(), last, body.coordinate); i >= 0)
      outcome.warn(resolution, body.name,
                   words("run.step: '", body.name, "' rotates by ", std::abs(v[body.coordinate]) * h * 180. / M_PI,
                         " degrees in a step, and the force of ", machine.forces().element_of(int(i)),
                         " changes with its angle; use at most a twentieth of a revolution, ",
                         2. * M_PI / std::abs(v[body.coordinate]) / 20., " s"));
  }
}

} // namespace

void require_steps_for_loads(const Machine &machine, const MethodOptions &method)
{
  const double omega = fastest_load(machine.linear().excitation()), h = method.step,
               steps = controlled(method) || method_of(method).carries_base() ? 1. : 2.;
  if (!(omega > 0.) || steps * h * omega <= 2. * M_PI * (1. - 1e-9))
    return;
  const double period = 2. * M_PI / omega;
  throw std::invalid_argument(words("run.step is ", h, " s, but a period of the load of ", 1. / period, " Hz is ",
                                    period, " s, which is too short for this step; use at most a twentieth of it, ",
                                    period / 20., " s"));
}

void check_step_resolution(Machine &machine, const MethodOptions &method, double begin, const LocalState &last,
                           const VectorXd &v, RunOutcome &outcome)
{
  const double h = method.step;
  if (controlled(method) || !(h > 0.) || !last.u.allFinite() || !v.allFinite())
    return;
  if (!method_of(method).carries_base())
    add_of_loads(machine, h, outcome);
  if (last.u.size() == 0)
    return;
  machine.events().follow_history(false);
  add_of_time(machine.forces(), last, begin, h, outcome);
  add_of_turning(machine, last, v, h, outcome);
}

} // namespace gestell::coupling
