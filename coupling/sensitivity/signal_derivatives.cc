#include "coupling/sensitivity/signal_derivatives.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double      longest = 0.32, shorter = 0.25; ///< ways of rates: of a step, and from one to the next
constexpr std::size_t ways      = 8;
constexpr double      accurate  = 1e-4;  ///< of y'', its error
constexpr int         most      = 3;     ///< of Newton's steps to where a signal turns
constexpr double      arrived   = 1e-3;  ///< of a way: no step is needed
constexpr double      same      = 0.25;  ///< share within which a jump is the same over both of two ways
constexpr double      of_values = 1e-13; ///< of the largest value of a signal, rounding of one value
constexpr double      distinct  = 30.;   ///< times its rounding is a jump at least

/// What a signal does over the two shortest ways is a jump: it does not become less with the way.
bool jumps(double at_far, double at_near, double rounding)
{
  return std::abs(at_near) > distinct * rounding && std::abs(at_far - at_near) < same * std::abs(at_near);
}
} // namespace

SignalDerivatives::SignalDerivatives(Machine &machine, const std::vector<Signal> &signals,
                                     const std::vector<ParameterTwins> &twins, VariationalEquation &equation)
    : machine_(machine), signals_(signals), twins_(twins), equation_(equation)
{
}

LocalState SignalDerivatives::local_at(const MotionState &state, const MotionColumns &columns, int k, double by) const
{
  LocalState local = state.local;
  local.u += by * columns.u.col(k);
  local.v += by * columns.u_rate.col(k);
  local.a += by * columns.u_acc.col(k);
  local.p += by * columns.p.col(k);
  local.lambda += by * columns.lambda.col(k);
  return local;
}

Told SignalDerivatives::tell(const MotionState &state, const MotionColumns &columns) const
{
  Told told{values(state), MatrixXd(Index(signals_.size()), Index(twins_.size()))};
  for (int k = 0; k < int(twins_.size()); ++k)
  {
    const ParameterTwins &twins = twins_[std::size_t(k)];
    const double          h     = twins.step;
    const LocalState      above = local_at(state, columns, k, h), below = local_at(state, columns, k, -h);
    const VectorXd        q_above = state.q + h * columns.q.col(k), q_below = state.q - h * columns.q.col(k),
                   v_above = state.v + h * columns.v.col(k), v_below = state.v - h * columns.v.col(k),
                   a_above = state.a + h * columns.a.col(k), a_below = state.a - h * columns.a.col(k);
    for (std::size_t i = 0; i < signals_.size(); ++i)
      told.dy(Index(i), k) = (twins.plus.machine->evaluate(twins.plus.signals[i], q_above, v_above, a_above, above) -
                              twins.minus.machine->evaluate(twins.minus.signals[i], q_below, v_below, a_below, below)) /
                             (2. * h);
  }
  return told;
}

VectorXd SignalDerivatives::values(const MotionState &state) const
{
  VectorXd y(Index(signals_.size()));
  for (std::size_t i = 0; i < signals_.size(); ++i)
    y[Index(i)] = machine_.evaluate(signals_[i], state.q, state.v, state.a, state.local);
  return y;
}

/// By quotients of order 4.
Course SignalDerivatives::course(const MotionState &state, double way)
{
  const auto  &lags = equation_.lags();
  const Course still{state.a, VectorXd::Zero(state.a.size())};
  Course       found = still;
  for (const auto &[by, of_rate, of_second] :
       {std::tuple(way, 8. / 12., 16. / 12.), std::tuple(2. * way, -1. / 12., -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there = moved(state, still, sign * by);
      found.third += sign * of_rate / way * there.a; // of lags zero
      for (const int i : lags)
      {
        found.second[i] += sign * of_rate / way * there.v[i];
        found.third[i] += of_second / (way * way) * (there.v[i] - state.v[i]);
      }
    }
  return found;
}

/// On the branches of here.
MotionState SignalDerivatives::moved(const MotionState &state, const Course &course, double by)
{
  MotionState there = state;
  there.t           = state.t + by;
  there.q           = state.q + by * state.v + 0.5 * by * by * course.second + by * by * by / 6. * course.third;
  there.v           = state.v + by * course.second + 0.5 * by * by * course.third;
  equation_.linearisation().complete(there);
  return there;
}

/// Columns that go with moved().
MotionColumns SignalDerivatives::moved(const MotionState &at, const MotionColumns &columns, double by)
{
  MotionColumns there;
  there.q = columns.q + by * columns.v + 0.5 * by * by * columns.a;
  there.v = columns.v + by * columns.a;
  Linearised linearised;
  equation_.linearisation().linearise(at, linearised);
  equation_.solve(linearised, 0., there);
  return there;
}

/// By central quotients of two distances: order 4.
void SignalDerivatives::find_rates(const MotionState &state, double way, LocalState &rates, VectorXd &y_rates)
{
  const Course on = course(state, way);
  rates           = state.local;
  y_rates.setZero(Index(signals_.size()));
  for (VectorXd *x : {&rates.u, &rates.v, &rates.a, &rates.p, &rates.lambda})
    x->setZero();
  for (const auto &[by, weight] : {std::pair(way, 8. / 12.), std::pair(2. * way, -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there  = moved(state, on, sign * by);
      const double      factor = sign * weight / way;
      rates.u += factor * there.local.u;
      rates.v += factor * there.local.v;
      rates.a += factor * there.local.a;
      rates.p += factor * there.local.p;
      rates.lambda += factor * there.local.lambda;
      y_rates += factor * values(there);
    }
}

bool Turn::known() const
{
  return off <= accurate * std::abs(second);
}

/// Rates here.  @return the way over which they were found
double SignalDerivatives::find_turn(std::size_t signal, const MotionState &at, double step, double size, Turn &found)
{
  struct Over
  {
    double way, rate, second, before, behind, jump; ///< jump: y behind less y before
  };
  const auto   y    = [&](const MotionState &m) { return machine_.evaluate(signals_[signal], m.q, m.v, m.a, m.local); };
  const double here = y(at);
  std::vector<Over> over;
  for (double way = longest * step; over.size() < ways; way *= shorter)
  {
    const Course on     = course(at, way);
    const auto   rise   = [&](double by) { return y(moved(at, on, by)) - here; };
    const double near[] = {rise(-way), rise(way)}, far[] = {rise(-2. * way), rise(2. * way)};
    over.push_back({way, (8. * (near[1] - near[0]) - (far[1] - far[0])) / (12. * way),
                    (16. * (near[0] + near[1]) - (far[0] + far[1])) / (12. * way * way),
                    (far[0] - 4. * near[0]) / (2. * way), (4. * near[1] - far[1]) / (2. * way), near[1] - near[0]});
  }
  const auto  differ = [&](std::size_t j) { return std::abs(over[j].second - over[j + 1].second); };
  std::size_t best   = 0;
  for (std::size_t j = 1; j + 1 < ways; ++j)
    best = differ(j) < differ(best) ? j : best;
  // Where rounding, which grows by the square of the ways, is less than what they differ by, the next is better.
  const double rounds = best + 2 < ways ? differ(best + 1) * shorter * shorter : differ(best);
  found.off           = std::min(rounds, differ(best));
  best += 2. * rounds < differ(best) ? 1 : 0;
  const Over  &last = over[ways - 1], &but_one = over[ways - 2];
  const double rounding = of_values * size;
  found.rate            = over[best].rate;
  found.second          = over[best].second;
  found.before          = last.before;
  found.behind          = last.behind;
  found.kink            = jumps(but_one.jump, last.jump, rounding) ? Kink::jump
                          : jumps(but_one.behind - but_one.before, last.behind - last.before, rounding / last.way) ? Kink::corner
                                                                                                                   : Kink::none;
  return over[best].way;
}

VectorXd SignalDerivatives::d_rates(std::size_t signal, const MotionState &at, const MotionColumns &columns, double way)
{
  const Course on    = course(at, way);
  VectorXd     found = VectorXd::Zero(Index(twins_.size()));
  for (const auto &[by, weight] : {std::pair(way, 8. / 12.), std::pair(2. * way, -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there = moved(at, on, sign * by);
      found += sign * weight / way * tell(there, moved(there, columns, sign * by)).dy.row(Index(signal)).transpose();
    }
  return found;
}

Turn SignalDerivatives::turn(std::size_t signal, MotionState at, MotionColumns columns, double step, double size)
{
  Turn   found;
  double way = find_turn(signal, at, step, size, found);
  for (int k = 0; k < most; ++k)
  {
    const double by = -found.rate / found.second;
    if (!found.known() || !(std::abs(by) < step) || std::abs(by) < arrived * way)
      break;
    at      = moved(at, course(at, way), by);
    columns = moved(at, columns, by);
    way     = find_turn(signal, at, step, size, found);
  }
  found.dy     = tell(at, columns).dy.row(Index(signal)).transpose();
  found.d_rate = d_rates(signal, at, columns, way);
  return found;
}

} // namespace gestell::coupling
