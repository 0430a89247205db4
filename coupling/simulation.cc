#include "coupling/simulation.h"

#include "coupling/integration/bdf.h"
#include "coupling/integration/bdf_stability.h"
#include "coupling/integration/energy_balance.h"
#include "coupling/integration/event_detection.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::coupling
{

namespace
{

std::string percent(double share)
{
  std::ostringstream text;
  text << std::setprecision(2) << 100. * share << " %";
  return text.str();
}

/// Follows a run: extremes at every step, rows and pictures at their own intervals.
class Recorder
{
public:
  Recorder(Machine &machine, const RunOptions &options, const std::vector<Signal> &signals, RunResult &result)
      : machine_(machine), signals_(signals), result_(result), energy_(machine), with_energy_(options.energy),
        values_(signals.size()), row_every_(interval(options.output_step, options.step)),
        picture_every_(options.picture_step > 0. ? interval(options.picture_step, options.step) : 0)
  {
    result.columns = {"t"};
    result.units   = {"s"};
    for (const Signal &signal : signals)
    {
      result.signals.push_back({signal.name, signal.unit});
      result.columns.push_back(signal.name);
      result.units.push_back(signal.unit);
    }
    if (with_energy_)
      for (const char *name : {"energy input", "energy stored", "energy dissipated"})
      {
        result.columns.push_back(name);
        result.units.push_back("J");
      }
    const double steps = (options.end - options.begin) / options.step;
    result.rows.reserve(static_cast<std::size_t>(steps / row_every_ + 3) * result.columns.size());
  }

  void begin(const Instant &instant)
  {
    if (with_energy_)
      energy_.begin(instant);
    record(instant, 0);
  }

  void step(const Instant &instant, long index)
  {
    if (with_energy_)
    {
      energy_.step(instant);
      balance(instant);
    }
    record(instant, index);
  }

  /// The last instant always has a row.
  void finish(const Instant &instant)
  {
    if (result_.rows.empty() || result_.rows[result_.rows.size() - result_.columns.size()] != instant.t)
      row(instant);
    for (std::size_t i = 0; i < signals_.size(); ++i)
      result_.signals[i].final = values_[i];
    if (result_.energy.residual > 0.01 * turned_over_)
      result_.warnings.push_back("the energy balance is open by " + percent(result_.energy.residual / turned_over_) +
                                 " of the energy turned over: the step is too large for this motion");
  }

private:
  static long interval(double wanted, double step) { return std::max(1L, std::lround(wanted / step)); }

  void record(const Instant &instant, long index)
  {
    for (std::size_t i = 0; i < signals_.size(); ++i)
    {
      const double value     = machine_.evaluate(signals_[i], instant.q, instant.v, instant.local);
      values_[i]             = value;
      SignalSummary &summary = result_.signals[i];
      if (index == 0 || value < summary.min)
      {
        summary.min   = value;
        summary.t_min = instant.t;
      }
      if (index == 0 || value > summary.max)
      {
        summary.max   = value;
        summary.t_max = instant.t;
      }
    }
    if (index % row_every_ == 0)
      row(instant);
    if (picture_every_ > 0 && index % picture_every_ == 0)
    {
      result_.picture_times.push_back(instant.t);
      result_.picture_states.push_back(instant.q);
    }
  }

  void row(const Instant &instant)
  {
    result_.rows.push_back(instant.t);
    result_.rows.insert(result_.rows.end(), values_.begin(), values_.end());
    if (!with_energy_)
      return;
    result_.rows.insert(result_.rows.end(), {result_.energy.input, result_.energy.stored, result_.energy.dissipated});
  }

  void balance(const Instant &instant)
  {
    const EnergyState energy = energy_.state(instant);
    result_.energy           = {energy.input, energy.stored, energy.dissipated,
                                std::max(result_.energy.residual, std::abs(energy.residual()))};
    turned_over_ = std::max({turned_over_, std::abs(energy.input), std::abs(energy.stored), energy.dissipated});
  }

  Machine                   &machine_;
  const std::vector<Signal> &signals_;
  RunResult                 &result_;
  EnergyBalance              energy_;
  bool                       with_energy_;
  std::vector<double>        values_;
  long                       row_every_, picture_every_;
  double                     turned_over_ = 0.; ///< largest energy in the balance so far [J]
};

[[noreturn]] void refuse(const std::string &key, double value, const std::string &needed)
{
  std::ostringstream message;
  message << "run." << key << " is " << value << " s; " << needed;
  throw std::invalid_argument(message.str());
}

void check(const RunOptions &options, std::size_t n_columns)
{
  if (!(options.step > 0.))
    refuse("step", options.step, "it must be positive");
  if (!(options.end > options.begin))
    refuse("end", options.end, "it must lie after the start");
  const double steps = (options.end - options.begin) / options.step;
  if (!(steps <= 1e10))
    refuse("step", options.step, "that makes more than 1e10 steps; take a longer one");
  const double bytes = 8. * double(n_columns) * steps * options.step / std::max(options.output_step, options.step);
  if (bytes > 8e9)
    refuse("step", options.step, "its history would take more than 8 GB; give output.step a larger value");
}

/// Orders above 2 are refused where they would blow up.
void check_stability(const Machine &machine, const RunOptions &options)
{
  if (options.order <= 2)
    return;
  const auto unstable = unstable_mode(options.order, machine.spectrum(), options.step);
  if (!unstable)
    return;
  std::ostringstream message;
  message << "run.order: BDF of order " << options.order << " is unstable for the mode at "
          << unstable->mode.omega / 6.283185307179586 << " Hz with damping ratio " << unstable->mode.zeta
          << ": with run.step = " << options.step << " s it grows by the factor " << unstable->growth
          << " in every step; order 2 is stable for every mode";
  throw std::invalid_argument(message.str());
}

void take_work(const IntegrationWork &work, RunResult &result)
{
  result.work = {work.steps, work.rejected, work.newton, work.factorisations, work.solves};
  if (work.rejected > 0)
    result.warnings.push_back("Newton failed in " + std::to_string(work.rejected) +
                              " steps; they were divided into steps of implicit Euler");
}

} // namespace

RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop)
{
  check(options, signals.size() + 4);
  check_stability(machine, options);
  const auto wall_start = std::chrono::steady_clock::now();
  RunResult  result;

  Bdf::Options bdf;
  bdf.order            = options.order;
  bdf.step             = options.step;
  bdf.max_halvings     = options.max_halvings;
  bdf.newton.tolerance = options.newton_tolerance;
  Bdf            integrator(machine, bdf);
  EventDetection detection(machine);
  Recorder       recorder(machine, options, signals, result);

  LocalState local;
  machine.gather(options.begin, initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  machine.start(local);
  integrator.begin(options.begin, initial.q, initial.v);
  detection.begin(local);
  recorder.begin(integrator.instant());

  const long n_steps        = std::lround(std::ceil((options.end - options.begin) / options.step - 1e-9));
  const long progress_every = machine.size() > 1000 ? 4 : 1024;
  if (options.begin + double(n_steps) * options.step > options.end + 1e-9 * options.step)
    result.warnings.push_back("run.step does not divide the run: it ends at the first step past run.end");
  std::vector<Event> events;
  try
  {
    for (long k = 1; k <= n_steps; ++k)
    {
      integrator.advance();
      const Instant &now = integrator.instant();
      detection.step(local, now.local, events);
      machine.accept(now.local);
      local = now.local;
      recorder.step(now, k);
      if (stop && stop->load(std::memory_order_relaxed))
      {
        result.interrupted = true;
        break;
      }
      if (progress && k % progress_every == 0)
        progress(now.t);
    }
  }
  catch (const ConvergenceFailure &failure)
  {
    result.failure = failure.what();
  }
  recorder.finish(integrator.instant());
  for (const Event &event : events)
    result.events.push_back({event.t, event.name, event.kind});
  take_work(integrator.work(), result);
  if (detection.chattering_steps() > 0)
    result.warnings.push_back("chatter: in " + std::to_string(detection.chattering_steps()) +
                              " steps more transitions followed each other than are recorded; take a smaller step");
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  return result;
}

} // namespace gestell::coupling
