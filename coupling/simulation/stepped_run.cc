#include "coupling/simulation/stepped_run.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "coupling/simulation/no_tiny_numbers.h"
#include "coupling/simulation/recorder.h"
#include "coupling/simulation/run_method.h"
#include "coupling/simulation/simulation.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

constexpr double no_time      = 1e-9; ///< share of a step that rounding may leave
constexpr double same_instant = 1e-6; ///< share of a step within which two instants are told as one

/// Refuses an unstable method; what is to be told of it otherwise.
std::vector<std::string> guarded(const Machine &machine, const InitialState &initial, const RunOptions &options,
                                 const MethodOptions &method)
{
  const LinearSpectrum spectrum = spectrum_for(machine, initial, method);
  const StabilityGuard guard(spectrum, method);
  if (!options.force_unstable)
    guard.check();
  return guard.warnings();
}

EventOptions events_of(const RunOptions &options, double still)
{
  EventOptions events;
  events.locate = options.events;
  events.still  = still;
  return events;
}

/// The driver cannot tell, as it knows no end.
LoadedMotion loaded(Machine &machine, const InitialState &initial, const RunOptions &options,
                    const ResumableSteps &steps)
{
  if (!steps.controls_error())
    return {};
  LocalState at;
  at.resize(machine);
  machine.gather(options.begin, initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), at);
  machine.events().follow_history(false);
  machine.events().start(at);
  return loads_to_come(machine, at, options.end);
}

/// Nothing is kept of a run that others follow.
RunOptions without_history(RunOptions options)
{
  options.allow_large = true;
  return options;
}

} // namespace

SteppedRun::SteppedRun(Machine &machine, const InitialState &initial, const RunOptions &options,
                       std::vector<Signal> signals)
    : machine_(machine), options_(without_history(options)), method_(with_largest_step(machine, options)),
      signals_(std::move(signals)), steps_(machine, (check_run(machine, options_, signals_.size()),
                                                     machine.will_read(signals_), make_integrator(machine, method_))),
      driver_(machine, steps_, events_of(options, initial.still)), joint_guard_(machine, steps_),
      coordinates_(coordinates_of(signals_)), accelerations_(accelerations_for(signals_, machine)),
      q_(Eigen::VectorXd::Zero(machine.size())), v_(q_), a_(q_), values_(signals_.size()), target_(options.begin),
      slack_(no_time * method_.step)
{
  const NoTinyNumbers while_it_starts;
  inside_.resize(machine);
  warnings_ = guarded(machine, initial, options, method_);
  driver_.on_step([this] { look_at_step(); });
  driver_.on_event([this](const Event &event) { note(event); });
  loaded_ = loaded(machine, initial, options, steps_);
  begin(options.begin, initial.q, initial.v);
}

void SteppedRun::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  driver_.begin(t, q, v);
  if (steps_.controls_error())
    steps_.expect(loaded_.way, loaded_.speed);
  now_   = t;
  ahead_ = false;
}

void SteppedRun::note(const Event &event)
{
  events_.push_back(event);
  if (!ended_.empty())
    return;
  ended_ = end_by_switch(machine_, options_.begin, event);
  end_   = event.t;
}

bool SteppedRun::is_now(double t) const
{
  return std::abs(t - now_) <= same_instant * method_.step;
}

/// Its dense output and the history that holds on it are there.
void SteppedRun::look_at_step()
{
  joint_guard_.step();
  on_step_ = machine_.events().save_history();
  if (!ahead_ && steps_.time() > target_ + slack_)
    look_into_step(target_, on_step_);
}

/// @param history  that held on the last step
void SteppedRun::look_into_step(double t, const Eigen::VectorXd &history)
{
  steps_.interpolate(t, inside_);
  steps_.interpolate(t, q_, v_);
  ahead_ = true;
  now_   = t;
  there_ = {t, q_, v_, history, ended()};
  if (accelerations_)
    a_ = accelerations_->at(t, steps_, inside_, q_, v_);
  evaluate(inside_);
}

void SteppedRun::evaluate(const LocalState &local)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    values_[i] = machine_.evaluate(signals_[i], q_, v_, a_, local);
}

/// The history is that of its end.
void SteppedRun::look_behind_step(double t, Eigen::VectorXd on_step)
{
  const Eigen::VectorXd behind = machine_.events().save_history();
  machine_.events().restore_history(on_step);
  look_into_step(t, on_step);
  machine_.events().restore_history(behind);
}

/// The last step reaches to t as well.  Behind an event its dense output is gone, and it is made anew.
bool SteppedRun::stays_in_step(double t)
{
  if (!ahead_ || !(steps_.time() > t + slack_))
    return false;
  if (!(steps_.step_begin() < steps_.time()))
  {
    restore(there_);
    return false;
  }
  look_behind_step(t, there_.history);
  return true;
}

/// A step that goes over its events may go over the end, which is looked at within it; without a dense output the run
/// ends at the instant it has come to.
void SteppedRun::end_in_step()
{
  if (ended_.empty() || end_ > target_ + slack_ || end_ >= steps_.time() - slack_)
    return;
  if (steps_.step_begin() < steps_.time())
    return look_behind_step(end_, on_step_);
  end_         = ahead_ ? now_ : steps_.time();
  there_.ended = ended_;
}

void SteppedRun::go_on_to(double t)
{
  const NoTinyNumbers while_it_runs;
  if (stays_in_step(ended_.empty() ? t : std::min(t, end_)))
    return;
  ahead_  = false;
  target_ = t;
  while (ended_.empty() && steps_.time() < t - slack_)
  {
    driver_.advance();
    if (!ahead_)
      now_ = steps_.time();
  }
  end_in_step();
  if (!ahead_)
    now_ = ended_.empty() ? steps_.time() : end_;
}

void SteppedRun::load_jumped()
{
  if (ahead_)
    restore(there_);
  else
    steps_.load_jumped();
}

const std::vector<double> &SteppedRun::values()
{
  if (ahead_)
    return values_;
  const LocalState &local = steps_.local();
  if (accelerations_)
    a_ = accelerations_->at(local.t, steps_, local, q_, v_);
  else if (!coordinates_.empty())
    steps_.motion_at(local.t, coordinates_, q_, v_);
  evaluate(local);
  return values_;
}

std::vector<Event> SteppedRun::take_events()
{
  const auto later = std::find_if(events_.begin(), events_.end(), [&](const Event &e) { return e.t > now_; });
  const std::vector<Event> taken(events_.begin(), later);
  events_.erase(events_.begin(), later);
  return taken;
}

SteppedState SteppedRun::state()
{
  const Instant     &now = steps_.instant();
  const SteppedState state =
      ahead_ ? there_ : SteppedState{now.t, now.q, now.v, machine_.events().save_history(), ended()};
  restore(state);
  return state;
}

void SteppedRun::restore(const SteppedState &state)
{
  const NoTinyNumbers while_it_starts;
  const SteppedState  at = state; // it may be the own one
  ended_                 = at.ended;
  end_                   = at.t;
  events_.erase(std::remove_if(events_.begin(), events_.end(), [&](const Event &e) { return e.t > at.t; }),
                events_.end());
  steps_.begin_with(at.history, options_.events);
  begin(at.t, at.q, at.v);
}

} // namespace gestell::coupling
