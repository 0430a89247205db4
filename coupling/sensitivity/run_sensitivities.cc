#include "coupling/sensitivity/run_sensitivities.h"

#include "coupling/sensitivity/extreme_derivatives.h"
#include "coupling/sensitivity/growth.h"
#include "coupling/sensitivity/meeting_events.h"
#include "coupling/sensitivity/signal_derivatives.h"
#include "coupling/sensitivity/variational_steps.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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

constexpr double little    = 0.02; ///< of their step: increment of quotients in time
constexpr double same_time = 1e-9; ///< of the run's length: what locating two events leaves of one

/// Second pass over the run, with its derivatives.
class Passage
{
public:
  explicit Passage(const SensitivityProblem &problem);
  RunSensitivities result();

private:
  void        start();
  void        expect();
  void        compare_structures(double t, const std::string &after);
  void        pass_piece(std::size_t number);
  void        advance_to(double t);
  void        tell_end();
  void        tell_window();
  RowVectorXd shift_of(double MachineTwin::*instant) const;
  void        take_events(std::size_t number);
  void        take_transition(int guard, const MotionState &state, const MotionColumns &columns, const RowVectorXd &dt);
  void        tell_piece_begin(std::size_t number);
  RowVectorXd event_time_derivatives(int guard, const MotionState &state, const MotionColumns &columns);

  const SensitivityProblem      &problem_;
  Machine                       &machine_;
  int                            K_;
  VariationalEquation            equation_;
  SignalDerivatives              signals_;
  VariationalSteps               steps_;
  double                         near_; ///< [s] instants closer than this coincide
  ExtremeDerivatives             extremes_;
  std::vector<OutputDerivatives> events_;
  Growth                         growth_;
  VectorXd                       lambda_;
  MatrixXd                       s_, s_rate_;
  RowVectorXd                    dt_; ///< derivatives of the instant of the events at the start of the piece
  bool                           interrupted_ = false;
};

/// Tolerance of the variational equations: derivatives are no more accurate than the motion.
double tolerance_for(const MethodOptions &method)
{
  constexpr double finest = 1e-8, coarse = 1e-6; // tolerances of a step of the variational equations
  if (controlled(method))
    return std::clamp(100. * method.tolerance, finest, coarse);
  constexpr double of_fixed_steps = 1e-5; // tolerance of these steps in runs by fixed steps of order 1 or 2
  return method.order > 2 ? finest : of_fixed_steps;
}

/// Order of a method of fixed steps, if 1 or 2; otherwise 0.
int order_of_steps(const MethodOptions &method)
{
  return controlled(method) || method.order > 2 ? 0 : method.order;
}

double length_of(const RunOptions &options)
{
  return options.end - options.begin;
}

double first_step(const SensitivityProblem &problem)
{
  const double length = length_of(problem.options);
  if (problem.options.method.step > 0. && !controlled(problem.options.method))
    return problem.options.method.step *
           std::exp2(std::min(4., std::floor(std::log2(length / problem.options.method.step))));
  return length / 1024.;
}

Passage::Passage(const SensitivityProblem &problem)
    : problem_(problem), machine_(problem.machine), K_(int(problem.twins.size())), equation_(machine_, problem.twins),
      signals_(machine_, problem.signals, problem.twins, equation_),
      steps_(equation_, first_step(problem), tolerance_for(problem.options.method),
             order_of_steps(problem.options.method), problem.options.method.step),
      near_(same_time * length_of(problem.options)),
      extremes_(problem.run, problem.twins, problem.options.begin, near_, length_of(problem.options)),
      growth_(machine_, equation_.mass_diagonal(), problem.trajectory, problem.twins)
{
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

/// Sets the expected sizes of the derivatives from the range and the speed of the motion.
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
  RowVectorXd per_value(K_);
  for (int k = 0; k < K_; ++k)
    per_value[k] = 1. / std::abs(problem_.twins[std::size_t(k)].value);
  constexpr double expected = 0.01; // relative change of the motion by the parameter: a scale of errors
  steps_.expect(expected * (high - low) * per_value, expected * fast * per_value);
  if (controlled(problem_.options.method))
    steps_.separate_shifts(high - low, fast, length_of(problem_.options) / one_percent * per_value);
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
      text << "sensitivities: after " << after << " at t = " << t << " s the machine has other branches with "
           << twins.key << " = " << twins.value << " -+ " << twins.step
           << ": there the run has no derivative by this parameter; remove it, or choose a value away from that point";
      throw std::invalid_argument(text.str());
    }
}

/// dt_e of a guard that is zero here, before its transition.
RowVectorXd Passage::event_time_derivatives(int guard, const MotionState &state, const MotionColumns &columns)
{
  const double way = little * steps_.step();
  const Course on  = signals_.course(state, way);
  VectorXd     g(std::max(1, machine_.events().n_guards())), below = g, above = g;
  const auto   guard_at = [&](double by)
  {
    const MotionState there = signals_.moved(state, on, by);
    machine_.events().guard_values(there.local, g);
    return g[guard];
  };
  const double near = guard_at(0.1 * way) - guard_at(-0.1 * way), far = guard_at(0.2 * way) - guard_at(-0.2 * way);
  const double rate = (8. * near - far) / (1.2 * way);
  RowVectorXd  dt(K_);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    twins.plus.machine->events().guard_values(signals_.local_at(state, columns, k, twins.step), above);
    twins.minus.machine->events().guard_values(signals_.local_at(state, columns, k, -twins.step), below);
    dt[k] = -(above[guard] - below[guard]) / (2. * twins.step) / rate;
  }
  const double moves = std::abs(guard_at(steps_.step()) - guard_at(-steps_.step())) +
                       std::abs(guard_at(steps_.step()) + guard_at(-steps_.step()));
  constexpr double touching = 1e-4; // rate of a guard, over its change in a step: it only touches zero
  if (!(std::abs(rate) * steps_.step() > touching * moves))
  {
    const ActiveGuard  active = machine_.events().guard(guard);
    std::ostringstream text;
    text << "sensitivities: at t = " << state.t << " s \"" << active.name << "\" (" << active.kind
         << ") touches its switching point instead of crossing it: there are no derivatives after it; end the run "
            "before (run.end), or change a parameter to avoid the grazing motion";
    throw std::invalid_argument(text.str());
  }
  return dt;
}

void Passage::take_transition(int guard, const MotionState &state, const MotionColumns &columns, const RowVectorXd &dt)
{
  LocalState rates;
  VectorXd   y_rates;
  signals_.find_rates(state, little * steps_.step(), rates, y_rates);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &twins = problem_.twins[std::size_t(k)];
    for (const double sign : {1., -1.})
    {
      EventSystem &events = (sign > 0. ? twins.plus : twins.minus).machine->events();
      LocalState   local  = signals_.local_at(state, columns, k, sign * twins.step);
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
  equation_.linearisation().begin_piece({});
  dt_ = event_time_derivatives(piece.guards.front(), state, columns);
  LocalState rates;
  VectorXd   y_rates;
  signals_.find_rates(state, little * steps_.step(), rates, y_rates);
  const Told reported = signals_.tell(state, columns);
  extremes_.at_event(state.t, reported, y_rates, dt_);
  for (const int guard : piece.guards)
  {
    const ActiveGuard active = machine_.events().guard(guard);
    const std::string name   = active.name + ' ' + active.kind;
    events_.push_back({"events." + std::to_string(events_.size() + 1) + ".t", "s", state.t, dt_.transpose(), name});
    take_transition(guard, state, columns, dt_);
    compare_structures(state.t, "\"" + name + "\"");
    const VectorXd before = state.a;
    equation_.linearisation().complete(state);
    s_rate_   = columns.v + (before - state.a) * dt_;
    columns.v = s_rate_;
    Linearised at;
    equation_.linearisation().linearise(state, at);
    equation_.solve(at, 0., columns);
  }
  s_      = columns.q;
  lambda_ = state.local.lambda;
  if (number + 1 < problem_.trajectory.pieces().size())
  {
    VectorXd         change = problem_.trajectory.pieces()[number + 1].nodes.front().v - state.v;
    constexpr double jump   = 1e-6; // of the fastest coordinate: velocities that differ by more jump
    for (const int i : equation_.lags())
    {
      if (std::abs(change[i]) > jump * state.v.cwiseAbs().maxCoeff() && dt_.cwiseAbs().maxCoeff() > 0.)
      {
        std::ostringstream text;
        text << "sensitivities: the law of a motor or another first-order element changes at t = " << state.t
             << ", an instant that depends on the parameters; its jump is not supported: use differences of two runs "
                "with --set";
        throw std::invalid_argument(text.str());
      }
      change[i] = 0.;
    }
    if (!(change.cwiseAbs().maxCoeff() <= jump * state.v.cwiseAbs().maxCoeff()))
    {
      std::ostringstream text;
      text << "sensitivities: velocities jump at t = " << state.t
           << " s, as at a prescribed motion with a sudden speed; derivatives over an impulse are not supported: give "
              "the profile a ramp, or use differences of two runs with --set";
      throw std::invalid_argument(text.str());
    }
  }
}

/// At the start of a piece: after the events that began it, or at the start of the run.
void Passage::tell_piece_begin(std::size_t number)
{
  const MotionState &state = steps_.state();
  if (!extremes_.any_at(state.t))
    return;
  const Told reported = signals_.tell(state, steps_.columns());
  LocalState rates;
  VectorXd   y_rates = VectorXd::Zero(reported.y.size());
  if (number > 0)
    signals_.find_rates(state, little * steps_.step(), rates, y_rates);
  extremes_.at_event(state.t, reported, y_rates, dt_);
}

void Passage::advance_to(double t)
{
  interrupted_ = interrupted_ || !steps_.advance_to(t, problem_.stop);
}

void Passage::pass_piece(std::size_t number)
{
  const SmoothPiece &piece = problem_.trajectory.pieces()[number];
  steps_.begin(piece, lambda_, s_, s_rate_);
  tell_piece_begin(number);
  const double     begin = piece.nodes.front().t, end = piece.nodes.back().t;
  std::set<double> stops = extremes_.instants(begin, end);
  if (growth_.first_look() > begin && growth_.first_look() < end)
    stops.insert(growth_.first_look());
  for (const double stop : stops)
  {
    advance_to(stop);
    if (interrupted_)
      return;
    if (stop == problem_.options.from)
      tell_window();
    else
      for (const auto &[signal, size] : extremes_.turning_at(stop))
        extremes_.at_turn(stop, signal, signals_.turn(signal, steps_.state(), steps_.columns(), steps_.step(), size),
                          steps_.step());
    growth_.look(stop, steps_.columns().q);
  }
  advance_to(end);
  if (interrupted_)
    return;
  growth_.look(end, steps_.columns().q);
  s_      = steps_.columns().q;
  s_rate_ = steps_.columns().v;
  lambda_ = steps_.state().local.lambda;
  if (!piece.guards.empty())
    take_events(number);
}

/// How parameters move an instant that the scene gives.
RowVectorXd Passage::shift_of(double MachineTwin::*instant) const
{
  RowVectorXd shift(K_);
  for (int k = 0; k < K_; ++k)
  {
    const ParameterTwins &own = problem_.twins[std::size_t(k)];
    shift[k]                  = (own.plus.*instant - own.minus.*instant) / (2. * own.step);
  }
  return shift;
}

void Passage::tell_window()
{
  const Told reported = signals_.tell(steps_.state(), steps_.columns());
  LocalState rates;
  VectorXd   y_rates;
  signals_.find_rates(steps_.state(), little * steps_.step(), rates, y_rates);
  extremes_.at_window(steps_.state().t, reported, y_rates, shift_of(&MachineTwin::from));
}

void Passage::tell_end()
{
  const Told reported = signals_.tell(steps_.state(), steps_.columns());
  LocalState rates;
  VectorXd   y_rates;
  signals_.find_rates(steps_.state(), little * steps_.step(), rates, y_rates);
  extremes_.at_end(steps_.state().t, reported, y_rates, shift_of(&MachineTwin::end));
}

/// Warning about a motion that is too coarse for the derivatives of its equations along it.
std::string coarse_motion(const VariationalAccuracy &accuracy, const SensitivityProblem &problem)
{
  Index        worst;
  const double off    = accuracy.off.maxCoeff(&worst);
  const auto   n      = (accuracy.off.array() > VariationalAccuracy::believed).count();
  const auto  &method = problem.options.method;
  return "derivatives by " + problem.twins[std::size_t(worst)].key +
         (n > 1 ? " and " + std::to_string(n - 1) + (n > 2 ? " other parameters" : " other parameter") : "") +
         " after t = " + short_text(accuracy.after) + " s may have errors of about " + short_text(100. * off, 2) +
         " %: " +
         (controlled(method) ? "the steps of the run are too large for the motion there; use a smaller run.tolerance"
                             : "steps of " + short_text(method.step) +
                                   " s are too long for the motion there; use run.tolerance or a smaller run.step");
}

RunSensitivities Passage::result()
{
  const auto wall = std::chrono::steady_clock::now();
  start();
  expect();
  lambda_ = VectorXd::Zero(machine_.joints().n_rows());
  for (std::size_t i = 0; i < problem_.trajectory.pieces().size() && !interrupted_; ++i)
    pass_piece(i);
  if (!interrupted_)
    tell_end();
  RunSensitivities found;
  found.warnings = meeting_events(events_, problem_.twins, near_);
  for (std::string &warning : growth_.warnings())
    found.warnings.push_back(std::move(warning));
  if (std::isfinite(steps_.accuracy().after))
    found.warnings.push_back(coarse_motion(steps_.accuracy(), problem_));
  found.outputs = extremes_.take();
  found.outputs.insert(found.outputs.end(), events_.begin(), events_.end());
  found.interrupted = interrupted_;
  found.reached     = steps_.state().t;
  found.steps       = steps_.steps();
  found.wall_s      = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return found;
}

void refuse_unlocated(const SensitivityProblem &problem)
{
  if (!problem.options.events)
    throw std::invalid_argument("sensitivities need the instants of events: run.events = true");
  if (problem.run.work.chatter > 0)
    throw std::invalid_argument("sensitivities: " + std::to_string(problem.run.work.chatter) +
                                " steps had too many events to locate (chatter); there are no derivatives after them. "
                                "Soften the contact or the friction, or end the run before");
}

} // namespace

RunSensitivities run_sensitivities(const SensitivityProblem &problem)
{
  refuse_unlocated(problem);
  return Passage(problem).result();
}

} // namespace gestell::coupling
