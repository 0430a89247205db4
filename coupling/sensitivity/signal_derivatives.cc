#include "coupling/sensitivity/signal_derivatives.h"

#include <tuple>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
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

/// The motion at another instant by Taylor's series, on the branches of here.
MotionState SignalDerivatives::moved(const MotionState &state, const VectorXd &jerk, double by)
{
  MotionState there = state;
  there.t           = state.t + by;
  there.q           = state.q + by * state.v + 0.5 * by * by * state.a + by * by * by / 6. * jerk;
  there.v           = state.v + by * state.a + 0.5 * by * by * jerk;
  equation_.linearisation().complete(there);
  return there;
}

VectorXd SignalDerivatives::jerk(const MotionState &state, double by)
{
  const VectorXd zero = VectorXd::Zero(state.q.size());
  return (moved(state, zero, by).a - moved(state, zero, -by).a) / (2. * by);
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

/// Rates of the measures and forces, and of the signals, by central quotients of two distances: order 4.
void SignalDerivatives::find_rates(const MotionState &state, double way, LocalState &rates, VectorXd &y_rates)
{
  const VectorXd j = jerk(state, way);
  rates            = state.local;
  y_rates.setZero(Index(signals_.size()));
  for (VectorXd *x : {&rates.u, &rates.v, &rates.a, &rates.p, &rates.lambda})
    x->setZero();
  for (const auto &[by, weight] : {std::pair(way, 8. / 12.), std::pair(2. * way, -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there  = moved(state, j, sign * by);
      const double      factor = sign * weight / way;
      rates.u += factor * there.local.u;
      rates.v += factor * there.local.v;
      rates.a += factor * there.local.a;
      rates.p += factor * there.local.p;
      rates.lambda += factor * there.local.lambda;
      y_rates += factor * values(there);
    }
}

/// y', y'' and the rate of dy/dx here, of all signals.
SignalRates SignalDerivatives::rates(const MotionState &state, const MotionColumns &columns, double way)
{
  const VectorXd j = jerk(state, way), here = values(state);
  const Index    n = here.size();
  SignalRates    found{VectorXd::Zero(n), VectorXd::Zero(n), MatrixXd::Zero(n, Index(twins_.size()))};
  for (const auto &[by, of_rate, of_second] :
       {std::tuple(way, 8. / 12., 16. / 12.), std::tuple(2. * way, -1. / 12., -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there = moved(state, j, sign * by);
      const Told        told  = tell(there, moved(there, columns, sign * by));
      found.rate += sign * of_rate / way * told.y;
      found.d_rate += sign * of_rate / way * told.dy;
      found.second += of_second / (way * way) * (told.y - here);
    }
  return found;
}

} // namespace gestell::coupling
