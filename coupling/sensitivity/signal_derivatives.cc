#include "coupling/sensitivity/signal_derivatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double      longest = 0.32, shorter = 0.25; ///< distances of quotients: of a step, and ratio
constexpr double      epsilon   = std::numeric_limits<double>::epsilon(); ///< rounding of one value
constexpr std::size_t stretches = 8;    ///< of sigma, each four times as long as the one before
constexpr double      accurate  = 1e-4; ///< of y'', its error

/// Whether the change of a signal over the two shortest distances is a jump: it does not decrease with the distance.
bool jumps(double at_far, double at_near, double rounding)
{
  constexpr double same     = 0.25; // share within which a jump is the same over both of two ways
  constexpr double distinct = 30.;  // times its rounding is a jump at least
  return std::abs(at_near) > distinct * rounding && std::abs(at_far - at_near) < same * std::abs(at_near);
}

/// Quotients of order 4 over distances 1 and 2.
constexpr std::array<std::pair<double, double>, 4> of_rate = {
    {{1., 8. / 12.}, {-1., -8. / 12.}, {2., -1. / 12.}, {-2., 1. / 12.}}};

/// z += by * rate
void add(double by, const MotionState &rate, MotionState &z)
{
  z.t += by * rate.t;
  z.q += by * rate.q;
  z.v += by * rate.v;
  z.a += by * rate.a;
  z.local.t += by * rate.local.t;
  z.local.u += by * rate.local.u;
  z.local.v += by * rate.local.v;
  z.local.a += by * rate.local.a;
  z.local.p += by * rate.local.p;
  z.local.lambda += by * rate.local.lambda;
}

MotionState zero_like(const MotionState &z)
{
  MotionState zero = z;
  add(-1., z, zero);
  return zero;
}

/// The derivative of the motion with respect to one parameter, at a fixed time.
MotionState of_column(const MotionColumns &columns, int k, const MotionState &like)
{
  MotionState z  = zero_like(like);
  z.q            = columns.q.col(k);
  z.v            = columns.v.col(k);
  z.a            = columns.a.col(k);
  z.local.u      = columns.u.col(k);
  z.local.v      = columns.u_rate.col(k);
  z.local.a      = columns.u_acc.col(k);
  z.local.p      = columns.p.col(k);
  z.local.lambda = columns.lambda.col(k);
  return z;
}

/// y' over stretches of the motion along its rates: 2^2i times `way`.
VectorXd along(const Machine &machine, const Signal &signal, const Moving &z, double way)
{
  VectorXd rates = VectorXd::Zero(Index(stretches));
  for (Index i = 0; i < rates.size(); ++i)
  {
    const double sigma = way * std::exp2(2. * double(i));
    for (const auto &[by, weight] : of_rate)
    {
      MotionState there = z.at;
      add(by * sigma, z.rate, there);
      rates[i] += weight / sigma * machine.evaluate(signal, there.q, there.v, there.a, there.local);
    }
  }
  return rates;
}

/// Index of the first of the two neighbouring values that agree best. The rounding of the first value is added, and a
/// quarter of it for each next one.
Index best_of(const VectorXd &values, double rounding)
{
  const auto differ = [&](Index i)
  { return std::max(std::abs(values[i + 1] - values[i]), rounding * std::exp2(-2. * double(i))); };
  Index best = 0;
  for (Index i = 1; i + 1 < values.size(); ++i)
    best = differ(i) < differ(best) ? i : best;
  return best;
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
  Told reported{values(state), MatrixXd(Index(signals_.size()), Index(twins_.size()))};
  for (int k = 0; k < int(twins_.size()); ++k)
  {
    const ParameterTwins &twins = twins_[std::size_t(k)];
    const double          h     = twins.step;
    const LocalState      above = local_at(state, columns, k, h), below = local_at(state, columns, k, -h);
    const VectorXd        q_above = state.q + h * columns.q.col(k), q_below = state.q - h * columns.q.col(k),
                   v_above = state.v + h * columns.v.col(k), v_below = state.v - h * columns.v.col(k),
                   a_above = state.a + h * columns.a.col(k), a_below = state.a - h * columns.a.col(k);
    for (std::size_t i = 0; i < signals_.size(); ++i)
      reported.dy(Index(i), k) =
          (twins.plus.machine->evaluate(twins.plus.signals[i], q_above, v_above, a_above, above) -
           twins.minus.machine->evaluate(twins.minus.signals[i], q_below, v_below, a_below, below)) /
          (2. * h);
  }
  return reported;
}

VectorXd SignalDerivatives::values(const MotionState &state) const
{
  VectorXd y(Index(signals_.size()));
  for (std::size_t i = 0; i < signals_.size(); ++i)
    y[Index(i)] = machine_.evaluate(signals_[i], state.q, state.v, state.a, state.local);
  return y;
}

/// Course of the motion, by difference quotients of order 4.
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

/// The motion after the time `by`, on the present branches.
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

/// Rates by central quotients of two distances: order 4.
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
    double way, rate, second, before, after, jump; ///< jump: y after the instant minus y before it
  };
  const auto   y    = [&](const MotionState &m) { return machine_.evaluate(signals_[signal], m.q, m.v, m.a, m.local); };
  const double here = y(at);
  std::vector<Over>     over;
  constexpr std::size_t ways = 8; // from 0.32 to 2e-5 of a step: beyond, rounding of second differences is all
  for (double way = longest * step; over.size() < ways; way *= shorter)
  {
    const Course on     = course(at, way);
    const auto   rise   = [&](double by) { return y(moved(at, on, by)) - here; };
    const double near[] = {rise(-way), rise(way)}, far[] = {rise(-2. * way), rise(2. * way)};
    over.push_back({way, (8. * (near[1] - near[0]) - (far[1] - far[0])) / (12. * way),
                    (16. * (near[0] + near[1]) - (far[0] + far[1])) / (12. * way * way),
                    (far[0] - 4. * near[0]) / (2. * way), (4. * near[1] - far[1]) / (2. * way), near[1] - near[0]});
  }
  // Zeros agree where the signal changes by less than the rounding of its value.
  const auto differ = [&](std::size_t j)
  {
    return std::max(std::abs(over[j].second - over[j + 1].second),
                    epsilon * std::abs(here) / (over[j].way * over[j].way));
  };
  std::size_t best = 0;
  for (std::size_t j = 1; j + 1 < ways; ++j)
    best = differ(j) < differ(best) ? j : best;
  // Rounding grows with the inverse square of the distance. If the rounding estimated from the next difference is below
  // this difference, the next value is better.
  const double rounds = best + 2 < ways ? differ(best + 1) * shorter * shorter : differ(best);
  found.off           = std::min(rounds, differ(best));
  best += 2. * rounds < differ(best) ? 1 : 0;
  const Over      &last = over[ways - 1], &but_one = over[ways - 2];
  constexpr double of_values = 1e-13; // of the largest value of a signal, rounding of one value
  const double     rounding  = of_values * size;
  found.rate                 = over[best].rate;
  found.second               = over[best].second;
  found.before               = last.before;
  found.after                = last.after;
  const bool bends           = jumps(but_one.after - but_one.before, last.after - last.before, rounding / last.way);
  found.kink      = jumps(but_one.jump, last.jump, rounding) ? Kink::jump : bends ? Kink::corner : Kink::none;
  const bool slow = !found.known() && found.kink == Kink::none && find_slow_turn(signal, at, longest * step, found);
  return slow ? longest * step : over[best].way;
}

/// The motion with the rates of all values that signals read: known rates of q, q', u and u', others by quotients over
/// `way`.
Moving SignalDerivatives::moving(const MotionState &at, double way)
{
  const Course on = course(at, way);
  Moving       z{at, zero_like(at)};
  for (const auto &[by, weight] : of_rate)
    add(weight / way, moved(at, on, by * way), z.rate);
  z.rate.t = z.rate.local.t = 1.;
  z.rate.q                  = at.v;
  z.rate.v                  = on.second;
  z.rate.a                  = on.third;
  z.rate.local.u            = at.local.v;
  z.rate.local.v            = machine_.forces().directions().transpose() * on.second;
  return z;
}

/// The same of the derivatives by each parameter.
std::vector<Moving> SignalDerivatives::moving(const MotionState &at, const MotionColumns &columns, double way)
{
  const Course        on = course(at, way);
  std::vector<Moving> found;
  for (int k = 0; k < int(twins_.size()); ++k)
    found.push_back({of_column(columns, k, at), zero_like(at)});
  for (const auto &[by, weight] : of_rate)
  {
    const MotionColumns there = moved(moved(at, on, by * way), columns, by * way);
    for (int k = 0; k < int(twins_.size()); ++k)
      add(weight / way, of_column(there, k, at), found[std::size_t(k)].rate);
  }
  for (Moving &z : found)
  {
    z.rate.t = z.rate.local.t = 0.;
    z.rate.q                  = z.at.v;
    z.rate.local.u            = z.at.local.v;
  }
  return found;
}

/// For signals that are slow compared with the steps.
/// @return whether the turning point is known
bool SignalDerivatives::find_slow_turn(std::size_t signal, const MotionState &at, double way, Turn &found)
{
  VectorXd second[2];
  for (int j = 0; j < 2; ++j)
  {
    const double over = j == 0 ? way : shorter * way;
    const Course on   = course(at, over);
    second[j]         = VectorXd::Zero(Index(stretches));
    for (const auto &[by, weight] : of_rate)
      second[j] += weight / over * along(machine_, signals_[signal], moving(moved(at, on, by * over), over), way);
  }
  const double y    = machine_.evaluate(signals_[signal], at.q, at.v, at.a, at.local);
  const Index  best = best_of(second[0], epsilon * std::abs(y) / (way * way));
  const double off =
      std::max(std::abs(second[0][best + 1] - second[0][best]), std::abs(second[1][best] - second[0][best]));
  if (!(off <= accurate * std::abs(second[0][best])))
    return false;
  found.second = second[0][best];
  found.off    = off;
  found.rate   = along(machine_, signals_[signal], moving(at, way), way)[best];
  return true;
}

void SignalDerivatives::find_d_rates(std::size_t signal, const MotionState &at, const MotionColumns &columns,
                                     double way, Turn &found)
{
  const Moving z = moving(at, way);
  const double y = machine_.evaluate(signals_[signal], at.q, at.v, at.a, at.local);
  found.d_rate.resize(Index(twins_.size()));
  found.d_off.resize(Index(twins_.size()));
  const std::vector<Moving> by = moving(at, columns, way);
  for (std::size_t k = 0; k < twins_.size(); ++k)
  {
    const ParameterTwins &twins = twins_[k];
    VectorXd              rates = VectorXd::Zero(Index(stretches));
    for (const auto &[twin, sign] : {std::pair(&twins.minus, -1.), std::pair(&twins.plus, 1.)})
    {
      Moving there = z;
      add(sign * twins.step, by[k].at, there.at);
      add(sign * twins.step, by[k].rate, there.rate);
      rates += 0.5 * sign / twins.step * along(*twin->machine, twin->signals[signal], there, way);
    }
    const Index best       = best_of(rates, epsilon * std::abs(y) / (twins.step * way));
    found.d_rate[Index(k)] = rates[best];
    found.d_off[Index(k)]  = std::abs(rates[best + 1] - rates[best]);
  }
}

Turn SignalDerivatives::turn(std::size_t signal, MotionState at, MotionColumns columns, double step, double size)
{
  Turn          found;
  double        way  = find_turn(signal, at, step, size, found);
  constexpr int most = 3; // Newton steps to the turning point, with quadratic convergence to `arrived`
  for (int k = 0; k < most; ++k)
  {
    const double     by      = -found.rate / found.second;
    constexpr double arrived = 1e-3; // of a way: no step is needed, as extremes are flat
    if (!found.known() || !(std::abs(by) < step) || std::abs(by) < arrived * way)
      break;
    at      = moved(at, course(at, way), by);
    columns = moved(at, columns, by);
    way     = find_turn(signal, at, step, size, found);
  }
  found.dy = tell(at, columns).dy.row(Index(signal)).transpose();
  find_d_rates(signal, at, columns, way, found);
  return found;
}

} // namespace gestell::coupling
