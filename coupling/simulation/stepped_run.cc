#include "coupling/simulation/stepped_run.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/energy_check.h"
#include "coupling/simulation/checks/run_checks.h"
#include "coupling/simulation/flush_denormals.h"
#include "coupling/simulation/recorder.h"
#include "coupling/simulation/run_method.h"
#include "coupling/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gestell::coupling
{

namespace
{

constexpr double no_time    = 1e-9; ///< share of a step that rounding may leave
constexpr long   first_look = 64;   ///< steps, above the 50 that a controlled run has at least

/// The driver cannot predict the loads, because it does not know the end.
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
  return load_breakpoints(machine, at, options.end);
}

/// Options without a limit of size, because a stepped run stores no history.
RunOptions without_history(RunOptions options)
{
  options.allow_large = true;
  return options;
}

} // namespace

SteppedRun::SteppedRun(Machine &machine, const InitialState &initial, const RunOptions &options,
                       std::vector<Signal> signals)
    : machine_(machine), options_(without_history(options)), method_(with_largest_step(machine, options)),
      signals_(std::move(signals)),
      motion_(machine, (check_run(machine, options_, signals_.size()), machine.will_read(signals_),
                        std::make_unique<ResumableSteps>(machine, make_integrator(machine, method_)))),
      steps_(static_cast<ResumableSteps &>(motion_.integrator())), coordinates_(coordinates_of(signals_)),
      accelerations_(accelerations_for(signals_, machine)), q_(Eigen::VectorXd::Zero(machine.size())), v_(q_), a_(q_),
      values_(signals_.size()), target_(options.begin), slack_(no_time * method_.step), still_(initial.still),
      next_look_(first_look)
{
  const FlushDenormals while_it_starts;
  inside_.resize(machine);
  check_start(machine, initial, options_, method_, outcome_);
  loaded_ = loaded(machine, initial, options, steps_);
  begin(options.begin, initial.q, initial.v);
  if (options.energy)
    checks_.push_back(std::make_unique<EnergyCheck>(machine, steps_, options_, sampling_of(machine, method_)));
  for (auto &check : run_checks(machine, motion_, initial, options_, method_))
    checks_.push_back(std::move(check));
  motion_.watch(*this);
  for (const auto &check : checks_)
    motion_.watch(*check);
  checks_new_ = checks_now();
}

/// Begins a run whose end is unknown.
void SteppedRun::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  motion_.begin(t, q, v, {options_.events, std::numeric_limits<double>::infinity(), still_});
  if (steps_.controls_error())
    steps_.expect(loaded_.way, loaded_.speed);
  now_   = t;
  ahead_ = false;
}

void SteppedRun::event(const Event &event)
{
  events_.push_back(event);
  if (!ended_.empty())
    return;
  ended_ = end_by_switch(machine_, options_.begin, event);
  end_   = event.t;
}

bool SteppedRun::is_now(double t) const
{
  constexpr double same_instant = 1e-6; // share of a step within which two instants are reported as one
  return std::abs(t - now_) <= same_instant * method_.step;
}

/// The checks see it afterwards.
void SteppedRun::step()
{
  on_step_ = machine_.events().save_history();
  if (ahead_ || !(steps_.time() > target_ + slack_))
    return;
  checks_begin_ = checks_now();
  look_into_step(target_, on_step_, checks_at(target_));
}

/// @param history  valid in the last step
/// @param checks   their state at t
void SteppedRun::look_into_step(double t, const Eigen::VectorXd &history, std::string checks)
{
  steps_.interpolate(t, inside_);
  steps_.interpolate(t, q_, v_);
  ahead_ = true;
  now_   = t;
  there_ = {t, q_, v_, history, ended(), std::move(checks)};
  if (accelerations_)
    a_ = accelerations_->at(t, steps_, inside_, q_, v_);
  evaluate(inside_);
}

std::string SteppedRun::checks_now()
{
  StateArchive archive;
  for (const auto &check : checks_)
    archive(*check);
  return archive.bytes();
}

void SteppedRun::restore_checks(const std::string &state)
{
  StateArchive archive(state);
  for (const auto &check : checks_)
    archive(*check);
}

/// State of the checks at t inside the last step, whose history is the present one of the elements.
std::string SteppedRun::checks_at(double t)
{
  const std::string now = checks_now();
  restore_checks(checks_begin_);
  steps_.show_until(t);
  try
  {
    for (const auto &check : checks_)
      check->step();
  }
  catch (const ConvergenceFailure &)
  {
    steps_.show_whole_step();
    restore_checks(now);
    throw;
  }
  steps_.show_whole_step();
  std::string there = checks_now();
  restore_checks(now);
  return there;
}

void SteppedRun::evaluate(const LocalState &local)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    values_[i] = machine_.evaluate(signals_[i], q_, v_, a_, local);
}

/// The history is that at its end.
void SteppedRun::look_behind_step(double t, Eigen::VectorXd on_step)
{
  const Eigen::VectorXd after = machine_.events().save_history();
  machine_.events().restore_history(on_step);
  look_into_step(t, on_step, ahead_ ? checks_at(t) : checks_now());
  machine_.events().restore_history(after);
}

/// Whether the last step also contains t.  After an event its dense output is lost, and it is repeated.
bool SteppedRun::stays_in_step(double t)
{
  if (ahead_ && !ended_.empty() && now_ >= end_)
    return true;
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

/// A step that skips its events may also exceed the end, which is evaluated by dense output; without dense output the
/// run ends at the instant reached.
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
  const FlushDenormals while_it_runs;
  const double         end    = options_.end - slack_;
  const bool           before = now_ < end;
  try
  {
    move_to(t);
  }
  catch (const ConvergenceFailure &failure)
  {
    throw ConvergenceFailure(failure.what() + advice_on_failure(machine_, method_, steps_.instant()), failure.id(),
                             failure.place());
  }
  if (!(before && now_ >= end) && steps_.work().steps < next_look_)
    return;
  next_look_ = std::max(next_look_, 2 * steps_.work().steps);
  verify();
}

/// Parts of steps beyond time() are ignored.
void SteppedRun::verify()
{
  const std::string now = ahead_ ? checks_now() : "";
  if (ahead_)
    restore_checks(there_.checks);
  for (const auto &check : checks_)
    check->verify();
  if (ahead_)
    restore_checks(now);
}

std::string SteppedRun::finish(const std::string &failure, const std::string &id)
{
  const FlushDenormals while_they_tell;
  if (ahead_)
  {
    restore_checks(there_.checks);
    machine_.events().restore_history(there_.history);
    if (steps_.step_begin() < now_ && now_ < steps_.time())
      steps_.show_until(now_);
  }
  outcome_.stop(id, "", failure);
  for (const auto &check : checks_)
    check->finish(outcome_);
  machine_.events().follow_history(options_.events); // checks may have ended it
  return failure.empty() ? outcome_.failure : "";
}

std::vector<Finding> SteppedRun::take_findings()
{
  return std::exchange(outcome_.findings, {});
}

void SteppedRun::move_to(double t)
{
  if (stays_in_step(ended_.empty() ? t : std::min(t, end_)))
    return;
  ahead_  = false;
  target_ = t;
  while (ended_.empty() && steps_.time() < t - slack_)
  {
    motion_.advance();
    if (!ahead_)
      now_ = steps_.time();
  }
  end_in_step();
  if (!ahead_)
    now_ = ended_.empty() ? steps_.time() : end_;
}

void SteppedRun::load_jumped()
{
  const FlushDenormals while_it_starts;
  if (ahead_)
    restore(there_);
  else
    steps_.restart();
  for (const auto &check : checks_)
    check->event({now_, "", "input"});
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
      ahead_ ? there_ : SteppedState{now.t, now.q, now.v, machine_.events().save_history(), ended(), checks_now()};
  restore(state);
  return state;
}

void SteppedRun::restore(const SteppedState &state)
{
  const FlushDenormals while_it_starts;
  const SteppedState   at = state; // it may be a member of this run
  ended_                  = at.ended;
  end_                    = at.t;
  events_.erase(std::remove_if(events_.begin(), events_.end(), [&](const Event &e) { return e.t > at.t; }),
                events_.end());
  steps_.begin_with(at.history, options_.events);
  if (at.checks.empty())
    restore_checks(checks_new_);
  begin(at.t, at.q, at.v);
  if (!at.checks.empty())
    restore_checks(at.checks);
}

} // namespace gestell::coupling
