#include "coupling/simulation/recorder.h"

#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/forces_on_measures.h"
#include "coupling/simulation/run_state.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// share of the grid's step within which an instant is a grid point: rounding of sums of steps
constexpr double on_grid = 1e-9;

/// @throws ConvergenceFailure
void require_finite(const std::vector<Signal> &signals, const SignalSample &sample)
{
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (!std::isfinite(sample.values[i]))
    {
      std::ostringstream message;
      message << "signal " << signals[i].name << " is not a finite number at t = " << sample.t
              << " s; a formula or force law gives no finite value there, or the motion diverged";
      throw ConvergenceFailure(message.str());
    }
}

} // namespace

std::string non_finite_state_message(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  if (q.allFinite() && v.allFinite())
    return "";
  std::ostringstream message;
  message << "a coordinate is not a finite number at t = " << t
          << " s; a formula or force law gives no finite value there, or the motion diverged";
  return message.str();
}

std::vector<int> coordinates_of(const std::vector<Signal> &signals)
{
  std::set<int> coordinates;
  for (const Signal &signal : signals)
    for (const Measure *measure : {&signal.on_q, &signal.on_v})
      for (const auto &term : *measure) // a weight of zero: the signal reads the coordinate otherwise
        coordinates.insert(term.first);
  return {coordinates.begin(), coordinates.end()};
}

Recorder::Recorder(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
                   const std::vector<Signal> &signals, const Sampling &sampling, RunResult &result)
    : machine_(machine), integrator_(integrator), options_(options), signals_(signals), result_(result),
      keeper_(machine, integrator, options.states, options.begin, result.signals, result.states),
      around_(machine, integrator, options, result.signals, result.states), coordinates_(coordinates_of(signals)),
      accelerations_(accelerations_for(signals, machine)),
      extremes_(*this, sampling, signals, options.from, result.signals), row_step_(output_step(options)),
      picture_step_(options.picture_step)
{
  between_.q.setZero(machine.size());
  between_.v.setZero(machine.size());
  between_.local.resize(machine);
  probe_ = {0., std::vector<double>(signals.size())};

  result.from    = options.from;
  result.columns = {"t"};
  result.units   = {"s"};
  for (const Signal &signal : signals)
  {
    result.signals.push_back({signal.name, signal.unit});
    result.columns.push_back(signal.name);
    result.units.push_back(signal.unit);
  }
  if (options.energy)
  {
    energy_.emplace(machine, integrator, options, sampling);
    for (const char *name : {"energy input", "energy stored", "energy dissipated"})
    {
      result.columns.push_back(name);
      result.units.push_back("J");
    }
  }
  const double length = options.end - options.begin;
  result.rows.reserve(static_cast<std::size_t>(length / row_step_ + 3.) * result.columns.size());
  if (picture_step_ > 0.)
  {
    result.picture_states.reserve(static_cast<std::size_t>(length / picture_step_ + 2.));
    constexpr long close_least = 100; // smallest number of pictures close to events, else as many as on the grid
    close_budget_              = std::max(close_least, static_cast<long>(length / picture_step_));
  }
}

void Recorder::evaluate(double t, SignalSample &sample)
{
  const bool at_end = t == integrator_.time();
  if (!at_end)
    integrator_.interpolate(t, between_.local);
  tell(t, at_end ? integrator_.local() : between_.local, sample);
}

/// @param local  the motion of the measures at t
void Recorder::tell(double t, const LocalState &local, SignalSample &sample)
{
  if (accelerations_)
    a_ = accelerations_->at(t, integrator_, local, between_.q, between_.v);
  else if (!coordinates_.empty())
    integrator_.motion_at(t, coordinates_, between_.q, between_.v);
  sample.t   = t;
  double sum = 0.;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    sum += sample.values[i] = machine_.evaluate(signals_[i], between_.q, between_.v, a_, local);
  if (!std::isfinite(sum))
    require_finite(signals_, sample);
}

void Recorder::begin()
{
  if (energy_)
    energy_->begin();
  after_   = integrator_.local();
  pending_ = true;
  pictures();
  keeper_.follow();
  around_.follow();
}

/// Records the state after the last event, at which the last step began, or the initial state.
void Recorder::settle()
{
  pending_ = false;
  tell(after_.t, after_, probe_);
  extremes_.restart(probe_);
  values_behind();
  if (next_row_ == 0)
  {
    row(after_.t, probe_, result_.energy);
    next_row_ = 1;
  }
}

void Recorder::step()
{
  const double begin = integrator_.step_begin(), end = integrator_.time();
  if (!(end > begin))
    return;
  constexpr double brief = 1e-9; // share of the previous step: shorter durations are below the resolution of events
  if (pending_ && end - begin < brief * length_)
  {
    follow_briefly();
    return;
  }
  length_ = end - begin;
  if (pending_)
    settle();
  extremes_.step(end);
  balance();
  rows();
  pictures();
  keeper_.follow();
  around_.follow();
}

/// A step between two events at one instant.
void Recorder::follow_briefly()
{
  after_ = integrator_.local();
  balance();
}

void Recorder::balance()
{
  if (!energy_)
    return;
  energy_->step();
  result_.energy = energy_->summary();
}

void Recorder::event(const Event &event)
{
  values_before();
  extremes_.on_event(event.name);
  if (energy_)
    energy_->event(event);
  after_   = integrator_.local();
  pending_ = true;
  picture_event();
}

void Recorder::values_before()
{
  constexpr std::size_t most_event_values = 1000; // in a run: those of chattering contacts would fill the memory
  if (result_.event_values.size() == most_event_values)
    return;
  EventValues at;
  at.t = integrator_.time();
  if (extremes_.begun())
  {
    at.before = extremes_.last().values;
    for (std::size_t i = 0; i < signals_.size(); ++i)
      at.rate.push_back(extremes_.slope(i));
  }
  result_.event_values.push_back(std::move(at));
}

/// Records values after the events since the last settled state.
void Recorder::values_behind()
{
  for (; settled_ < result_.event_values.size(); ++settled_)
    result_.event_values[settled_].after = probe_.values;
}

void Recorder::rows()
{
  const double end = integrator_.time();
  for (double t; (t = options_.begin + double(next_row_) * row_step_) <= end + on_grid * row_step_; ++next_row_)
  {
    if (t >= end - on_grid * row_step_)
    {
      row(t, extremes_.last(), result_.energy);
      continue;
    }
    evaluate(std::max(t, integrator_.step_begin()), probe_);
    extremes_.see(probe_);
    row(t, probe_, energy_ ? energy_inside(probe_.t) : result_.energy);
  }
}

/// Energy at t in the last evaluated step.
EnergySummary Recorder::energy_inside(double t)
{
  between_.t = t;
  integrator_.interpolate(t, between_.q, between_.v);
  return energy_->inside(between_);
}

void Recorder::row(double t, const SignalSample &sample, const EnergySummary &energy)
{
  result_.rows.push_back(t);
  result_.rows.insert(result_.rows.end(), sample.values.begin(), sample.values.end());
  if (energy_)
    result_.rows.insert(result_.rows.end(), {energy.input, energy.stored, energy.dissipated});
}

/// Saves pictures on the grid and, for some steps after an event, on a much finer grid that shows ringing.
void Recorder::pictures()
{
  if (!(picture_step_ > 0.))
    return;
  const double   end            = integrator_.time() + on_grid * picture_step_;
  constexpr long close_pictures = 8; // after an event: pictures a step of the grid, of what rings faster than it
  const auto     at             = [&](long n) { return options_.begin + double(n) / close_pictures * picture_step_; };
  for (double t; (t = at(next_picture_)) <= end; ++next_picture_)
    if (next_picture_ % close_pictures == 0)
      picture(t);
    else if (t <= close_until_ && close_budget_ > 0)
    {
      --close_budget_;
      picture(t);
    }
}

void Recorder::picture(double t)
{
  if (t >= integrator_.time() - on_grid * picture_step_)
  {
    between_.q = integrator_.instant().q;
    between_.v = integrator_.instant().v;
    forces_on_measures(machine_, integrator_.local(), p_);
  }
  else
  {
    const double inside = std::max(t, integrator_.step_begin());
    integrator_.interpolate(inside, between_.q, between_.v);
    integrator_.interpolate(inside, between_.local);
    forces_on_measures(machine_, between_.local, p_);
  }
  if (const std::string words = non_finite_state_message(t, between_.q, between_.v); !words.empty())
    throw ConvergenceFailure(words);
  result_.picture_times.push_back(t);
  result_.picture_forces.push_back(p_);
  result_.picture_states.push_back(between_.q);
  result_.picture_velocities.push_back(between_.v);
}

/// An event is a picture by itself.
void Recorder::picture_event()
{
  const double t = integrator_.time();
  if (!(picture_step_ > 0.) || close_budget_ <= 0)
    return;
  constexpr long close_steps = 4; // of the grid, which are shown so
  close_until_               = t + close_steps * picture_step_;
  if (result_.picture_times.empty() || t > result_.picture_times.back() + on_grid * picture_step_)
  {
    --close_budget_;
    picture(t);
  }
}

/// Records the rest of the state after the last event.
void Recorder::settle_at_end(RunOutcome &outcome)
{
  try
  {
    if (pending_)
      settle();
  }
  catch (const ConvergenceFailure &failure)
  {
    outcome.stop(failure.id(), failure.place(), failure.what());
  }
}

void Recorder::finish(RunOutcome &outcome)
{
  settle_at_end(outcome);
  around_.finish();
  if (!extremes_.begun())
  {
    for (SignalSummary &signal : result_.signals)
      signal.min = signal.t_min = signal.max = signal.t_max = signal.final = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const SignalSample &last = extremes_.last();
  if (result_.rows.empty() || result_.rows[result_.rows.size() - result_.columns.size()] < last.t - on_grid * row_step_)
    row(last.t, last, result_.energy);
  for (std::size_t i = 0; i < signals_.size(); ++i)
  {
    result_.signals[i].final = last.values[i];
    if (!extremes_.reached())
      extremes_.reset_extremes(i);
    if (extremes_.watched(i))
      continue;
    outcome.warn("signal-window", signals_[i].name,
                 "signal " + signals_[i].name + " is evaluated from the event \"" + signals_[i].from +
                     "\", which did not occur: its extremes are the values at the end");
    extremes_.reset_extremes(i);
  }
  if (!extremes_.reached())
    outcome.warn("result-window", "output.from",
                 "the run ended before output.from = " + short_text(options_.from) +
                     " s, the start of the window for extremes: extremes are the values at the end");
  if (energy_)
    energy_->finish(outcome);
}

void Recorder::exchange(StateArchive &archive)
{
  archive(result_.signals, result_.rows, result_.event_values, result_.energy, result_.picture_times,
          result_.picture_states, result_.picture_velocities, result_.picture_forces);
  archive(keeper_, around_, between_, a_, extremes_, after_, pending_, length_, settled_, next_row_, next_picture_,
          close_until_, close_budget_);
  if (energy_)
    archive(*energy_);
}

} // namespace gestell::coupling
