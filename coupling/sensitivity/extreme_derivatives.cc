#include "coupling/sensitivity/extreme_derivatives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double rounding = 1e-9; ///< of the largest value of a signal: smaller values are rounding
/// Likewise at an event. The instant of an event is located to delta = 1e-12 s or better (rounding of times of some
/// seconds and of the event function). A signal that is zero there, such as the force of a contact with omega =
/// sqrt(c/m), then has the value y' delta = omega delta of its size: 1e-6 up to omega = 1e6 1/s, more than a run
/// resolves. Percentages of smaller values have no meaning.
constexpr double located = 1e-6;
constexpr double level   = 1e-4; ///< of the largest value: smaller changes by y' or y'' count as flat

const double none = std::numeric_limits<double>::quiet_NaN();
} // namespace

ExtremeDerivatives::ExtremeDerivatives(const RunResult &run, const std::vector<ParameterTwins> &twins, double begin,
                                       double near, double length)
    : twins_(twins), begin_(begin), near_(near), length_(length)
{
  const double far = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < run.signals.size(); ++i)
  {
    const SignalSummary &reported = run.signals[i];
    extremes_.push_back({i, false, reported.t_min, reported.min, far});
    extremes_.push_back({i, true, reported.t_max, reported.max, far});
    sizes_.push_back(std::max(std::abs(reported.min), std::abs(reported.max)));
    for (const auto &[name, of, value] :
         {std::tuple(".min", reported.unit, reported.min), std::tuple(".t_min", std::string("s"), reported.t_min),
          std::tuple(".max", reported.unit, reported.max), std::tuple(".t_max", std::string("s"), reported.t_max),
          std::tuple(".final", reported.unit, reported.final)})
      outputs_.push_back({reported.name + name, of, value, VectorXd::Constant(Index(twins.size()), none)});
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    outputs_[i].is_zero = i % 5 % 2 == 0 && std::abs(outputs_[i].value) <= located * sizes_[i / 5];
  for (const Extreme &extreme : extremes_)
    if (is_rounding(extreme))
      for (const bool instant : {false, true})
        leave_out(output(extreme, instant), "it is zero within rounding");
}

std::set<double> ExtremeDerivatives::instants(double begin, double end) const
{
  std::set<double> found;
  for (const Extreme &extreme : extremes_)
    if (extreme.t > begin + near_ && extreme.t < end - near_)
      found.insert(extreme.t);
  return found;
}

bool ExtremeDerivatives::any_at(double t) const
{
  return std::any_of(extremes_.begin(), extremes_.end(),
                     [&](const Extreme &extreme) { return std::abs(extreme.t - t) <= near_; });
}

OutputDerivatives &ExtremeDerivatives::output(const Extreme &extreme, bool instant)
{
  return outputs_[5 * extreme.signal + (extreme.largest ? 2 : 0) + (instant ? 1 : 0)];
}

void ExtremeDerivatives::leave_out(OutputDerivatives &output, const std::string &reason)
{
  output.derivative.setConstant(none);
  output.note = "no derivative: " + reason;
}

/// Whether the extreme is rounding. An exact zero is not: a force law can give it. Nor is the start, whose derivative
/// is known whatever rounding the start value has.
bool ExtremeDerivatives::is_rounding(const Extreme &extreme) const
{
  return extreme.t != begin_ && extreme.value != 0. && std::abs(extreme.value) <= rounding * sizes_[extreme.signal];
}

void ExtremeDerivatives::set(const Extreme &extreme, const VectorXd &of_value, const VectorXd &of_instant)
{
  OutputDerivatives &value = output(extreme, false), &instant = output(extreme, true);
  value.derivative   = of_value;
  instant.derivative = of_instant;
  value.note         = {};
  instant.note       = {};
}

void ExtremeDerivatives::at_event(double t, const Told &reported, const VectorXd &rates, const RowVectorXd &dt)
{
  for (Extreme &extreme : extremes_)
  {
    const Index  i   = Index(extreme.signal);
    const double off = std::abs(reported.y[i] - extreme.value);
    if (std::abs(extreme.t - t) > near_ || is_rounding(extreme))
      continue;
    if (extreme.t != begin_ && extreme.value != 0. && std::abs(extreme.value) <= located * sizes_[extreme.signal])
    {
      for (const bool instant : {false, true})
        leave_out(output(extreme, instant), "it is zero within the accuracy of its event");
      continue;
    }
    if (!(off < extreme.off - rounding * std::abs(extreme.value)))
      continue;
    extreme.off = off;
    set(extreme, reported.dy.row(i).transpose() + rates[i] * dt.transpose(), dt.transpose());
  }
}

std::map<std::size_t, double> ExtremeDerivatives::turning_at(double t) const
{
  std::map<std::size_t, double> found;
  for (const Extreme &extreme : extremes_)
    if (extreme.t == t && !is_rounding(extreme))
      found[extreme.signal] = sizes_[extreme.signal];
  return found;
}

void ExtremeDerivatives::at_turn(double t, std::size_t signal, const Turn &turn, double step)
{
  for (Extreme &extreme : extremes_)
    if (extreme.signal == signal && extreme.t == t && !is_rounding(extreme))
      take(extreme, turn, step);
}

/// The reason why an extreme is not at a turning point of its signal; empty if it is, or nearly.
std::string ExtremeDerivatives::no_turn(const Extreme &extreme, const Turn &turn, double step) const
{
  std::ostringstream text;
  if (turn.kink == Kink::jump)
    text << "the signal jumps there, at no event";
  else if (turn.kink == Kink::corner)
    text << "the signal has a corner there, where its rate goes from " << turn.before << " to " << turn.after
         << " per second";
  else if (std::abs(turn.rate) * step > level * sizes_[extreme.signal])
    text << "the signal has no turning point there, its rate is " << turn.rate << " per second";
  return text.str();
}

void ExtremeDerivatives::take(Extreme &extreme, const Turn &turn, double step)
{
  const double second = (extreme.largest ? -1. : 1.) * turn.second; // > 0 at a turning point
  const double shift  = -turn.rate / turn.second;
  // Change of the signal by its curvature over the whole run.
  const bool flat = std::abs(turn.second) * length_ * length_ < level * sizes_[extreme.signal];
  if (!turn.known() || flat || !(second > 0.) || !(std::abs(shift) < step))
  {
    set(extreme, turn.dy, VectorXd::Constant(turn.dy.size(), none));
    const std::string why = no_turn(extreme, turn, step);
    leave_out(output(extreme, true),
              !why.empty() ? why
              : flat       ? "the peak is flat"
                           : "the turning point of the signal is lost in rounding, or farther than a step");
    if (!why.empty())
      leave_out(output(extreme, false), why);
    return;
  }
  VectorXd dt  = -turn.d_rate / turn.second;
  bool     far = false, lost = false;
  // error of the derivative of an instant, relative: no more figures than y''
  constexpr double known_share = 1e-4;
  // or relative to the run's length, for a change by the whole value of the parameter
  constexpr double known_time = 1e-6;
  for (Index k = 0; k < turn.d_off.size(); ++k)
    if (const double off = std::abs(turn.d_off[k] / turn.second);
        off > known_share * std::abs(dt[k]) && off * std::abs(twins_[std::size_t(k)].value) > known_time * length_)
    {
      dt[k] = none;
      lost  = true;
    }
  for (Index k = 0; k < dt.size(); ++k)
    if (std::abs(one_percent * twins_[std::size_t(k)].value * dt[k]) > length_)
    {
      dt[k] = none;
      far   = true;
    }
  set(extreme, turn.dy + shift * turn.d_rate, dt);
  if (lost)
    output(extreme, true).note = "no derivative: the change of its rate is lost in rounding";
  if (far)
    output(extreme, true).note =
        "no derivative: 1 % of the parameter would shift it by more than the run; the peak is flat";
}

void ExtremeDerivatives::at_window(double t, const Told &reported, const VectorXd &rates, const RowVectorXd &dt)
{
  for (Extreme &extreme : extremes_)
    if (extreme.t == t && !is_rounding(extreme))
      set(extreme, reported.dy.row(Index(extreme.signal)).transpose() + rates[Index(extreme.signal)] * dt.transpose(),
          dt.transpose());
}

void ExtremeDerivatives::at_end(double t, const Told &reported, const VectorXd &rates, const RowVectorXd &end)
{
  for (std::size_t i = 0; i < sizes_.size(); ++i)
    outputs_[5 * i + 4].derivative = reported.dy.row(Index(i)).transpose() + rates[Index(i)] * end.transpose();
  for (Extreme &extreme : extremes_)
    if (std::abs(extreme.t - t) <= near_ && !is_rounding(extreme))
      set(extreme, outputs_[5 * extreme.signal + 4].derivative, end.transpose());
}

} // namespace gestell::coupling
