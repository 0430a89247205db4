#include "coupling/simulation/stepped_run.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "coupling/simulation/no_tiny_numbers.h"
#include "coupling/simulation/recorder.h"
#include "coupling/simulation/run_method.h"
#include "coupling/simulation/simulation.h"

#include <cmath>

namespace gestell::coupling
{

namespace
{

constexpr double no_time = 1e-9; ///< share of a step within which two instants are one

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
                    const CommunicatedSteps &steps)
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
      driver_(machine, steps_, events_of(options, initial.still)), coordinates_(coordinates_of(signals_)),
      accelerations_(accelerations_for(signals_, machine)), q_(Eigen::VectorXd::Zero(machine.size())), v_(q_), a_(q_),
      values_(signals_.size())
{
  const NoTinyNumbers while_it_starts;
  warnings_ = guarded(machine, initial, options, method_);
  driver_.on_event(
      [this](const Event &event)
      {
        if (ended_.empty())
          ended_ = end_by_switch(machine_, options_.begin, event);
      });
  loaded_ = loaded(machine, initial, options, steps_);
  begin(options.begin, initial.q, initial.v);
}

void SteppedRun::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  driver_.begin(t, q, v);
  if (steps_.controls_error())
    steps_.expect(loaded_.way, loaded_.speed);
}

bool SteppedRun::is_now(double t) const
{
  return std::abs(t - time()) <= no_time * method_.step;
}

void SteppedRun::go_on_to(double t)
{
  const NoTinyNumbers while_it_runs;
  const double        slack = no_time * method_.step;
  steps_.cut_at(t + slack); // what rounding leaves between step and piece is no reason to cut
  while (ended_.empty() && time() < t - slack)
    driver_.advance();
}

void SteppedRun::load_jumped()
{
  steps_.load_jumped();
}

const std::vector<double> &SteppedRun::values()
{
  const LocalState &local = steps_.local();
  if (accelerations_)
    a_ = accelerations_->at(local.t, steps_, local, q_, v_);
  else if (!coordinates_.empty())
    steps_.motion_at(local.t, coordinates_, q_, v_);
  for (std::size_t i = 0; i < signals_.size(); ++i)
    values_[i] = machine_.evaluate(signals_[i], q_, v_, a_, local);
  return values_;
}

MotionState SteppedRun::state()
{
  const Instant    &now = steps_.instant();
  const MotionState state{now.t, now.q, now.v, machine_.events().save_history()};
  restore(state);
  return state;
}

void SteppedRun::restore(const MotionState &state)
{
  const NoTinyNumbers while_it_starts;
  ended_.clear();
  steps_.begin_with(state.history, options_.events);
  begin(state.t, state.q, state.v);
}

} // namespace gestell::coupling
