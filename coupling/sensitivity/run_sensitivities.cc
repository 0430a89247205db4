#include "coupling/sensitivity/run_sensitivities.h"

#include "coupling/sensitivity/variational_steps.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double finest = 1e-8, coarsest = 1e-6; ///< tolerances of a step of the variational equations
constexpr double little      = 0.02;             ///< of their step, over which rates in time are taken
constexpr double same_time   = 1e-9;             ///< of the run's length
constexpr double jump        = 1e-6;             ///< of the fastest coordinate: velocities that differ by more jump
constexpr double touching    = 1e-6; ///< of what a guard moves in a step, its rate: it touches its zero only
constexpr double one_percent = 0.01;

constexpr double expected = 0.01; ///< relative change of the motion by that of a parameter: less need not be exact

const double none = std::numeric_limits<double>::quiet_NaN();

/// Signals at a motion, [n_y], and their derivatives [n_y x K].
struct Told
{
  VectorXd y;
  MatrixXd dy;
};

/// The run gone over once more, with its derivatives.
class Passage
{
public:
  explicit Passage(const SensitivityProblem &problem);
  RunSensitivities result();

private:
  struct Extreme
  {
    std::size_t signal;
    bool        largest;
    double      t, value;
  };

  void        start();
  void        expect();
  void        warn_of_order();
  void        compare_structures(double t, const std::string &after);
  void        pass_piece(std::size_t number);
  void        take_events(std::size_t number);
  void        take_transition(int guard, const MotionState &state, const MotionColumns &columns, const RowVectorXd &dt);
  void        tell_piece_begin(std::size_t number);
  void        look_at_extremes(double t);
  void        at_extreme(Extreme &extreme);
  void        at_event_extreme(Extreme &extreme, const Told &told, const VectorXd &rates, const RowVectorXd &dt);
  Told        tell(const MotionState &state, const MotionColumns &columns);
  VectorXd    values(const MotionState &state);
  void        find_rates(const MotionState &state, double way, LocalState &rates, VectorXd &y_rates);
  MotionState moved(const MotionState &state, const VectorXd &jerk, double by);
  MotionColumns moved(const MotionState &at, const MotionColumns &columns, double by);
  VectorXd      jerk(const MotionState &state, double by);
  void find_signal_rates(const MotionState &state, const MotionColumns &columns, VectorXd &rate, VectorXd &second,
                         MatrixXd &d_rate);
  RowVectorXd        event_time_derivatives(int guard, const MotionState &state, const MotionColumns &columns);
  OutputDerivatives &output(const Extreme &extreme, bool instant);
  void               set(const Extreme &extreme, const VectorXd &of_value, const VectorXd &of_instant);
  LocalState         local_at(const MotionState &state, const MotionColumns &columns, int k, double by) const;

  const SensitivityProblem &problem_;
  Machine                  &machine_;
  int                       K_;
  VariationalEquation       equation_;
  VariationalSteps          steps_;
  RunSensitivities          result_;
  std::vector<Extreme>      extremes_;
  std::size_t               event_ = 0;
  VectorXd                  lambda_;
  MatrixXd                  s_, s_rate_;
  RowVectorXd               dt_; ///< of the events at the begin of the piece
  double                    near_ = 0.;
};

/// Derivatives are no better than the motion they follow.
double tolerance_for(const MethodOptions &method)
{
  if (controlled(method))
    return std::clamp(100. * method.tolerance, finest, coarsest);
  return method.order > 2 ? finest : coarsest;
}

double first_step(const SensitivityProblem &problem)
{
  const double length = problem.options.end - problem.options.begin;
  if (problem.options.method.step > 0. && !controlled(problem.options.method))
    return problem.options.method.step *
           std::exp2(std::min(4., std::floor(std::log2(length / problem.options.method.step))));
  return length / 1024.;
}

Passage::Passage(const SensitivityProblem &problem)
    : problem_(problem), machine_(problem.machine), K_(int(problem.twins.size())), equation_(machine_, problem.twins),
      steps_(equation_, first_step(problem), tolerance_for(problem.options.method))
{
  near_ = same_time * (problem.options.end - problem.options.begin);
  for (std::size_t i = 0; i < problem.signals.size(); ++i)
  {
    const SignalSummary &told = problem.run.signals[i];
    extremes_.push_back({i, false, told.t_min, told.min});
    extremes_.push_back({i, true, told.t_max, told.max});
    const std::string unit = told.unit;
    for (const auto &[name, of, value] :
         {std::tuple(".min", unit, told.min), std::tuple(".t_min", std::string("s"), told.t_min),
          std::tuple(".max", unit, told.max), std::tuple(".t_max", std::string("s"), told.t_max),
          std::tuple(".final", unit, told.final)})
      result_.outputs.push_back({told.name + name, of, value, VectorXd::Constant(K_, none)});
  }
}

OutputDerivatives &Passage::output(const Extreme &extreme, bool instant)
{
  return result_.outputs[5 * extreme.signal + (extreme.largest ? 2 : 0) + (instant ? 1 : 0)];
}

void Passage::set(const Extreme &extreme, const VectorXd &of_value, const VectorXd &of_instant)
{
  output(extreme, false).derivative = of_value;
  output(extreme, true).derivative  = of_instant;
}

/// Derivatives of the start: quotients of the starts of both machines, moved to where their joints close.
void Passage::start()
{
  const MotionNode &first = problem_.trajectory.pieces().front().nodes.front();
  machine_.events().follow_history(true);
  machine_.events().restore_history(problem_.trajectory.history());
  s_.resize(first.q.size(), K_);
  s_rate_.resize(first.q.size(), K_);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    VectorXd              q[2], v[2];
    for (int side = 0; side < 2; ++side)
    {
      const MachineTwin &twin    = side == 0 ? twins.minus : twins.plus;
      Machine           &machine = *twin.machine;
      LocalState         local;
      local.resize(machine);
      q[side] = twin.initial.q;
      v[side] = twin.initial.v;
      local.t = first.t;
      local.u = machine.forces().directions().transpose() * q[side];
      local.v = machine.forces().directions().transpose() * v[side];
      machine.events().follow_history(false);
      machine.events().start(local);
      machine.events().follow_history(true);
      if (machine.events().n_guards() != machine_.events().n_guards() || !machine_.forces().held().empty())
        machine.events().restore_history(problem_.trajectory.history());
      if (machine.joints().n_rows() > 0)
        ConsistentStart(machine, "the variational equations").project(q[side], v[side], local);
    }
    s_.col(k)      = (q[1] - q[0]) / (2. * twins.step);
    s_rate_.col(k) = (v[1] - v[0]) / (2. * twins.step);
  }
  compare_structures(first.t, "the start");
  dt_ = RowVectorXd::Zero(K_);
}

/// What the motion goes through, for a share of the parameter's value.
void Passage::expect()
{
  const auto &pieces = problem_.trajectory.pieces();
  VectorXd    low = pieces.front().nodes.front().q, high = low, fast = VectorXd::Zero(low.size());
  for (const SmoothPiece &piece : pieces)
    for (const MotionNode &node : piece.nodes)
    {
      low  = low.cwiseMin(node.q);
      high = high.cwiseMax(node.q);
      fast = fast.cwiseMax(node.v.cwiseAbs());
    }
  RowVectorXd share(K_);
  for (int k = 0; k < K_; ++k)
    share[k] = expected / std::abs(problem_.twins[std::size_t(k)].value);
  steps_.expect((high - low) * share, fast * share);
}

/// Both machines of every parameter are in the branches of the run.
void Passage::compare_structures(double t, const std::string &after)
{
  for (const ParameterTwins &twins : problem_.twins)
    for (const MachineTwin *twin : {&twins.minus, &twins.plus})
    {
      const EventSystem &own = machine_.events(), &its = twin->machine->events();
      bool               same =
          own.n_guards() == its.n_guards() && machine_.forces().held().size() == twin->machine->forces().held().size();
      for (int i = 0; same && i < own.n_guards(); ++i)
        same = own.guard(i).kind == its.guard(i).kind && own.guard(i).name == its.guard(i).name;
      if (same)
        continue;
      std::ostringstream text;
      text << "sensitivities: behind " << after << " at t = " << t << " s the machine is in other branches with "
           << twins.key << " = " << twins.value << " -+ " << twins.step
           << ": there the run changes its course, and has no derivative by this parameter; leave it out, or take a "
              "value away from that point";
      throw std::invalid_argument(text.str());
    }
}

LocalState Passage::local_at(const MotionState &state, const MotionColumns &columns, int k, double by) const
{
  LocalState local = state.local;
  local.u += by * columns.u.col(k);
  local.v += by * columns.u_rate.col(k);
  local.a += by * columns.u_acc.col(k);
  local.p += by * columns.p.col(k);
  local.lambda += by * columns.lambda.col(k);
  return local;
}

Told Passage::tell(const MotionState &state, const MotionColumns &columns)
{
  Told told{values(state), MatrixXd(Index(problem_.signals.size()), K_)};
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    const double          h     = twins.step;
    const LocalState      above = local_at(state, columns, k, h), below = local_at(state, columns, k, -h);
    const VectorXd        q_above = state.q + h * columns.q.col(k), q_below = state.q - h * columns.q.col(k),
                   v_above = state.v + h * columns.v.col(k), v_below = state.v - h * columns.v.col(k),
                   a_above = state.a + h * columns.a.col(k), a_below = state.a - h * columns.a.col(k);
    for (std::size_t i = 0; i < problem_.signals.size(); ++i)
      told.dy(Index(i), k) = (twins.plus.machine->evaluate(twins.plus.signals[i], q_above, v_above, a_above, above) -
                              twins.minus.machine->evaluate(twins.minus.signals[i], q_below, v_below, a_below, below)) /
                             (2. * h);
  }
  return told;
}

VectorXd Passage::values(const MotionState &state)
{
  VectorXd y(Index(problem_.signals.size()));
  for (std::size_t i = 0; i < problem_.signals.size(); ++i)
    y[Index(i)] = machine_.evaluate(problem_.signals[i], state.q, state.v, state.a, state.local);
  return y;
}

/// The motion at another instant by Taylor's series, on the branches of here.
MotionState Passage::moved(const MotionState &state, const VectorXd &jerk, double by)
{
  MotionState there = state;
  there.t           = state.t + by;
  there.q           = state.q + by * state.v + 0.5 * by * by * state.a + by * by * by / 6. * jerk;
  there.v           = state.v + by * state.a + 0.5 * by * by * jerk;
  equation_.complete(there);
  return there;
}

VectorXd Passage::jerk(const MotionState &state, double by)
{
  const VectorXd zero = VectorXd::Zero(state.q.size());
  return (moved(state, zero, by).a - moved(state, zero, -by).a) / (2. * by);
}

/// Columns that go with moved().
MotionColumns Passage::moved(const MotionState &at, const MotionColumns &columns, double by)
{
  MotionColumns there;
  there.q = columns.q + by * columns.v + 0.5 * by * by * columns.a;
  there.v = columns.v + by * columns.a;
  Linearised linearised;
  equation_.linearise(at, linearised);
  equation_.solve(linearised, 0., there);
  return there;
}

/// Rates of the measures and forces, and of the signals, by central quotients of two distances: order 4.
void Passage::find_rates(const MotionState &state, double way, LocalState &rates, VectorXd &y_rates)
{
  const VectorXd j = jerk(state, way);
  rates            = state.local;
  y_rates.setZero(Index(problem_.signals.size()));
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

/// dt_e of a guard that is zero here, before its transition.
RowVectorXd Passage::event_time_derivatives(int guard, const MotionState &state, const MotionColumns &columns)
{
  const double way = little * steps_.step();
  VectorXd     g(std::max(1, machine_.events().n_guards())), below = g, above = g;
  const auto   guard_at = [&](double by)
  {
    const MotionState there = moved(state, VectorXd::Zero(state.q.size()), by);
    machine_.events().guard_values(there.local, g);
    return g[guard];
  };
  const double near = guard_at(0.1 * way) - guard_at(-0.1 * way), far = guard_at(0.2 * way) - guard_at(-0.2 * way);
  const double rate = (8. * near - far) / (1.2 * way);
  RowVectorXd  dt(K_);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    twins.plus.machine->events().guard_values(local_at(state, columns, k, twins.step), above);
    twins.minus.machine->events().guard_values(local_at(state, columns, k, -twins.step), below);
    dt[k] = -(above[guard] - below[guard]) / (2. * twins.step) / rate;
  }
  const double moves = std::abs(guard_at(steps_.step()) - guard_at(-steps_.step())) +
                       std::abs(guard_at(steps_.step()) + guard_at(-steps_.step()));
  if (!(std::abs(rate) * steps_.step() > touching * moves))
  {
    const ActiveGuard  active = machine_.events().guard(guard);
    std::ostringstream text;
    text << "sensitivities: at t = " << state.t << " s \"" << active.name << "\" (" << active.kind
         << ") touches its switching point rather than crosses it: behind it nothing has a derivative; end the run "
            "before (run.end), or move a parameter away from the grazing motion";
    throw std::invalid_argument(text.str());
  }
  return dt;
}

void Passage::take_transition(int guard, const MotionState &state, const MotionColumns &columns, const RowVectorXd &dt)
{
  LocalState rates;
  VectorXd   y_rates;
  find_rates(state, little * steps_.step(), rates, y_rates);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    for (const double sign : {1., -1.})
    {
      EventSystem &events = (sign > 0. ? twins.plus : twins.minus).machine->events();
      LocalState   local  = local_at(state, columns, k, sign * twins.step);
      const double by     = sign * twins.step * dt[k];
      local.t += by;
      local.u += by * rates.u;
      local.v += by * rates.v;
      local.a += by * rates.a;
      local.p += by * rates.p;
      local.lambda += by * rates.lambda;
      events.accept(local);
      events.transition(guard, local);
    }
  }
  machine_.events().accept(state.local);
  machine_.events().transition(guard, state.local);
}

/// Events at the end of a piece: they share the change of their time.
void Passage::take_events(std::size_t number)
{
  const SmoothPiece &piece   = problem_.trajectory.pieces()[number];
  MotionState        state   = steps_.state();
  MotionColumns      columns = steps_.columns();
  equation_.begin_piece({});
  dt_ = event_time_derivatives(piece.guards.front(), state, columns);
  LocalState rates;
  VectorXd   y_rates;
  find_rates(state, little * steps_.step(), rates, y_rates);
  const Told told = tell(state, columns);
  for (Extreme &extreme : extremes_)
    if (std::abs(extreme.t - state.t) <= near_)
      at_event_extreme(extreme, told, y_rates, dt_);
  for (const int guard : piece.guards)
  {
    const ActiveGuard active = machine_.events().guard(guard);
    const std::string name   = active.name + ' ' + active.kind;
    result_.outputs.push_back({"events." + std::to_string(++event_) + ".t", "s", state.t, dt_.transpose(), name});
    take_transition(guard, state, columns, dt_);
    compare_structures(state.t, "\"" + name + "\"");
    const VectorXd before = state.a;
    equation_.complete(state);
    s_rate_   = columns.v + (before - state.a) * dt_;
    columns.v = s_rate_;
    Linearised at;
    equation_.linearise(state, at);
    equation_.solve(at, 0., columns);
  }
  s_      = columns.q;
  lambda_ = state.local.lambda;
  if (number + 1 < problem_.trajectory.pieces().size())
  {
    VectorXd change = problem_.trajectory.pieces()[number + 1].nodes.front().v - state.v;
    for (const int i : equation_.lags())
      change[i] = 0.;
    if (!(change.cwiseAbs().maxCoeff() <= jump * state.v.cwiseAbs().maxCoeff()))
    {
      std::ostringstream text;
      text << "sensitivities: velocities jump at t = " << state.t
           << " s, as where a motion is prescribed with a sudden speed; derivatives over an impulse are not carried: "
              "give the profile a ramp, or take differences of two runs with --set";
      throw std::invalid_argument(text.str());
    }
  }
}

/// At an event the signal has two values: the extreme is that of before if it is as near.
void Passage::at_event_extreme(Extreme &extreme, const Told &told, const VectorXd &rates, const RowVectorXd &dt)
{
  const Index  i   = Index(extreme.signal);
  const double off = std::abs(told.y[i] - extreme.value);
  if (output(extreme, false).derivative.allFinite() && !(off < 1e-9 * std::abs(extreme.value)))
    return;
  set(extreme, told.dy.row(i).transpose() + rates[i] * dt.transpose(), dt.transpose());
}

/// y', y'' and the rate of dy/dx here, of all signals.
void Passage::find_signal_rates(const MotionState &state, const MotionColumns &columns, VectorXd &rate,
                                VectorXd &second, MatrixXd &d_rate)
{
  const double   way = little * steps_.step();
  const VectorXd j = jerk(state, way), here = values(state);
  const Index    n = here.size();
  rate.setZero(n);
  second.setZero(n);
  d_rate.setZero(n, K_);
  for (const auto &[by, of_rate, of_second] :
       {std::tuple(way, 8. / 12., 16. / 12.), std::tuple(2. * way, -1. / 12., -1. / 12.)})
    for (const double sign : {1., -1.})
    {
      const MotionState there = moved(state, j, sign * by);
      const Told        told  = tell(there, moved(there, columns, sign * by));
      rate += sign * of_rate / way * told.y;
      d_rate += sign * of_rate / way * told.dy;
      second += of_second / (way * way) * (told.y - here);
    }
}

void Passage::at_extreme(Extreme &extreme)
{
  const MotionState   &state   = steps_.state();
  const MotionColumns &columns = steps_.columns();
  const Told           told    = tell(state, columns);
  VectorXd             rate, second;
  MatrixXd             d_rate;
  find_signal_rates(state, columns, rate, second, d_rate);
  const Index    i     = Index(extreme.signal);
  const double   shift = second[i] != 0. ? -rate[i] / second[i] : 0.; // to where the signal turns
  const VectorXd slope = d_rate.row(i).transpose();
  set(extreme, told.dy.row(i).transpose() + shift * slope,
      second[i] != 0. ? VectorXd(-slope / second[i]) : VectorXd::Constant(K_, none));
}

/// At the begin of a piece: behind the events that began it, or the start of the run.
void Passage::tell_piece_begin(std::size_t number)
{
  const MotionState &state = steps_.state();
  const bool         any   = std::any_of(extremes_.begin(), extremes_.end(),
                                         [&](const Extreme &e) { return std::abs(e.t - state.t) <= near_; });
  if (!any)
    return;
  const Told told = tell(state, steps_.columns());
  LocalState rates;
  VectorXd   y_rates = VectorXd::Zero(told.y.size());
  if (number > 0)
    find_rates(state, little * steps_.step(), rates, y_rates);
  for (Extreme &extreme : extremes_)
    if (std::abs(extreme.t - state.t) <= near_)
      at_event_extreme(extreme, told, y_rates, dt_);
}

void Passage::pass_piece(std::size_t number)
{
  const SmoothPiece &piece = problem_.trajectory.pieces()[number];
  steps_.begin(piece, lambda_, s_, s_rate_);
  tell_piece_begin(number);
  const double     begin = piece.nodes.front().t, end = piece.nodes.back().t;
  std::set<double> stops;
  for (const Extreme &extreme : extremes_)
    if (extreme.t > begin + near_ && extreme.t < end - near_)
      stops.insert(extreme.t);
  for (const double stop : stops)
  {
    steps_.advance_to(stop);
    for (Extreme &extreme : extremes_)
      if (extreme.t == stop)
        at_extreme(extreme);
  }
  steps_.advance_to(end);
  s_      = steps_.columns().q;
  s_rate_ = steps_.columns().v;
  lambda_ = steps_.state().local.lambda;
  if (!piece.guards.empty())
    take_events(number);
}

/// By which share of its value a parameter makes neighbouring events meet, to first order: beyond, they change places
/// and the derivative says nothing.
void Passage::warn_of_order()
{
  std::vector<const OutputDerivatives *> events;
  for (const OutputDerivatives &output : result_.outputs)
    if (output.output.compare(0, 7, "events.") == 0)
      events.push_back(&output);
  for (int k = 0; k < K_; ++k)
  {
    const double value    = std::abs(problem_.twins[std::size_t(k)].value);
    double       smallest = one_percent;
    std::string  which;
    for (std::size_t i = 1; i < events.size(); ++i)
    {
      const double gap   = events[i]->value - events[i - 1]->value;
      const double share = gap / (std::abs(events[i]->derivative[k] - events[i - 1]->derivative[k]) * value);
      if (gap > near_ && share < smallest)
      {
        smallest = share;
        which    = events[i - 1]->note + " and " + events[i]->note;
      }
    }
    if (which.empty())
      continue;
    std::ostringstream text;
    text.precision(2);
    text << "a change of " << problem_.twins[std::size_t(k)].key << " by " << 100. * smallest << " % makes " << which
         << " meet; its derivatives hold for less";
    result_.warnings.push_back(text.str());
  }
}

RunSensitivities Passage::result()
{
  const auto wall = std::chrono::steady_clock::now();
  start();
  expect();
  lambda_ = VectorXd::Zero(machine_.joints().n_rows());
  for (std::size_t i = 0; i < problem_.trajectory.pieces().size(); ++i)
    pass_piece(i);
  const Told told = tell(steps_.state(), steps_.columns());
  LocalState rates;
  VectorXd   y_rates;
  find_rates(steps_.state(), little * steps_.step(), rates, y_rates);
  RowVectorXd end(K_);
  for (int k = 0; k < K_; ++k)
    end[k] = (problem_.twins[std::size_t(k)].plus.end - problem_.twins[std::size_t(k)].minus.end) /
             (2. * problem_.twins[std::size_t(k)].step);
  for (std::size_t i = 0; i < problem_.signals.size(); ++i)
    result_.outputs[5 * i + 4].derivative = told.dy.row(Index(i)).transpose() + y_rates[Index(i)] * end.transpose();
  for (Extreme &extreme : extremes_)
    if (std::abs(extreme.t - steps_.state().t) <= near_)
      set(extreme, result_.outputs[5 * extreme.signal + 4].derivative, end.transpose());
  warn_of_order();
  result_.steps  = steps_.steps();
  result_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return std::move(result_);
}

void refuse_unlocated(const SensitivityProblem &problem)
{
  if (!problem.options.events)
    throw std::invalid_argument("sensitivities need the instants of events: run.events = true");
  if (problem.run.work.chatter > 0)
    throw std::invalid_argument("sensitivities: " + std::to_string(problem.run.work.chatter) +
                                " steps had more events than are located (chatter) and were gone over; behind them "
                                "nothing has a derivative. Soften the contact or the friction, or end the run before");
}

} // namespace

RunSensitivities run_sensitivities(const SensitivityProblem &problem)
{
  refuse_unlocated(problem);
  return Passage(problem).result();
}

} // namespace gestell::coupling
