#include "coupling/simulation/simulation.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/run_checks.h"
#include "coupling/simulation/checks/step_collapse_guard.h"
#include "coupling/simulation/checks/step_resolution_check.h"
#include "coupling/simulation/flush_denormals.h"
#include "coupling/simulation/recorder.h"
#include "coupling/simulation/resumable_run.h"
#include "coupling/simulation/run_method.h"
#include "coupling/simulation/run_result.h"
#include "coupling/simulation/watched_values.h"
#include "fem/values/available_memory.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <sstream>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// Memory of a run's results [bytes].
struct KeptBytes
{
  double history, pictures, states;
};

template <typename... Parts>
[[noreturn]] void too_large(const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

KeptBytes kept_bytes(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  const double length = options.end - options.begin, columns = 1. + double(n_signals) + (options.energy ? 3. : 0.),
               picture_rate = options.picture_step > 0. ? 1. / options.picture_step : 0.,
               state_rate   = options.states.step > 0. ? 1. / options.states.step : 0.;
  return {8. * columns * (length / output_step(options) + 1.), 32. * machine.size() * (length * picture_rate + 1.),
          8. * machine.size() * (length * state_rate + 1.)};
}

/// A run stores its history, pictures and states in memory.
/// @throws std::invalid_argument if they are larger than 1 GB, or the pictures more than 20 000, unless
/// options.allow_large is set
void require_size(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  constexpr double most_pictures = 2e4; // chosen: half an hour of a film at 10 pictures a second
  const double     count = options.picture_step > 0. ? (options.end - options.begin) / options.picture_step : 0.;
  if (!options.allow_large && count > most_pictures)
    too_large("output.picture_step gives ", count, " pictures of several files each; use more than ",
              options.picture_step, " s, or set output.allow_large = true");
  const auto [history, pictures, states] = kept_bytes(machine, options, n_signals);
  constexpr double most_bytes            = 1e9; // what a laptop has to spare
  if (!options.allow_large && states > most_bytes)
    too_large("the run would store ", states / 1e9, " GB of states to find the largest stress; set output.stress.step ",
              "above ", options.states.step, " s, or set output.allow_large = true");
  if (options.allow_large || history + pictures <= most_bytes)
    return;
  too_large("the run would store ", history / 1e9, " GB of history and ", pictures / 1e9,
            " GB of states for pictures; set output.step", history > pictures ? "" : " or output.picture_step",
            " above ", history > pictures ? output_step(options) : options.picture_step,
            " s, or set output.allow_large = true");
}

/// Requests the state of a run from time to time, so that it can be resumed.
class CheckpointPace
{
public:
  CheckpointPace(const RunCheckpoints *checkpoints, std::function<std::string()> state)
      : checkpoints_(checkpoints), state_(std::move(state))
  {
  }

  bool is_due() const { return checkpoints_ && checkpoints_->every > 0. && Clock::now() >= due_; }

  /// The next one is due so late that keeping them takes half a per cent of the time.
  void keep()
  {
    if (!checkpoints_)
      return;
    const Clock::time_point from = Clock::now();
    checkpoints_->keep(state_());
    const std::chrono::duration<double> cost = Clock::now() - from;
    due_ = Clock::now() + length(std::max(checkpoints_->every, cost.count() / share_of_checkpoints));
  }

private:
  using Clock                                  = std::chrono::steady_clock;
  static constexpr double share_of_checkpoints = 0.005; // of the time of a run

  static Clock::duration length(double seconds)
  {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  const RunCheckpoints        *checkpoints_;
  std::function<std::string()> state_;
  Clock::time_point            due_ = Clock::now() + length(checkpoints_ ? std::min(checkpoints_->every, 1e6) : 0.);
};

template <typename... Parts>
[[noreturn]] void refuse(const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

EventOptions event_options(const RunOptions &options, double still)
{
  return {options.events, options.end, still};
}

/// If a run fails before its first instant nothing is known.
void fail_at_start(const ConvergenceFailure &failure, const Machine &machine, RunResult &result)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  result.failure =
      std::string("no initial state: ") + failure.what() + faults_of(machine, -std::numeric_limits<double>::infinity());
  for (SignalSummary &signal : result.signals)
    signal.min = signal.t_min = signal.max = signal.t_max = signal.final = none;
}

} // namespace

void check_run(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  check_method(options.method);
  if (!(options.end > options.begin))
    refuse("run.end is ", options.end, " s; it must be after the start at ", options.begin, " s");
  if (!(options.from < options.end))
    refuse("output.from is ", options.from, " s; it must be before run.end = ", options.end, " s");
  if (!controlled(options.method) && !((options.end - options.begin) / options.method.step <= most_steps))
    refuse("run.step is ", options.method.step, " s, which gives more than 1e10 steps; use a longer step");
  require_steps_for_loads(machine, options.method);
  require_size(machine, options, n_signals);
}

void try_start(Machine &machine, const InitialState &initial, const RunOptions &options)
{
  Motion motion(machine, make_integrator(machine, with_largest_step(machine, options)));
  motion.begin(options.begin, initial.q, initial.v, event_options(options, initial.still));
}

namespace
{

/// Stores the motion for computations along it afterwards.
class TrajectoryKeeper : public RunObserver
{
public:
  TrajectoryKeeper(Trajectory &trajectory, Machine &machine, const TimeIntegrator &integrator, double spacing)
      : trajectory_(trajectory), machine_(machine), integrator_(integrator), spacing_(spacing)
  {
  }

  void begin() override { trajectory_.begin(integrator_.instant(), machine_.events().save_history()); }
  void step() override { trajectory_.step(integrator_, spacing_); }
  void guard(int number) override { trajectory_.guard(number); }

private:
  Trajectory           &trajectory_;
  Machine              &machine_;
  const TimeIntegrator &integrator_;
  double                spacing_; ///< [s] largest distance of nodes
};

/// A run under way: the motion and its observers.
class Run : private RunObserver
{
public:
  Run(Machine &machine, const RunOptions &options, const MethodOptions &method, const std::vector<Signal> &signals,
      RunResult &result)
      : machine_(machine), options_(options), method_(method), result_(result),
        motion_(machine, make_integrator(machine, method)), sampling_(sampling_of(machine, method)),
        recorder_(machine, motion_.integrator(), options, signals, sampling_, result)
  {
  }

  /// @throws ConvergenceFailure if the machine does not start
  void begin(const InitialState &initial)
  {
    motion_.begin(options_.begin, initial.q, initial.v, event_options(options_, initial.still));
  }

  void look_on(const InitialState &initial, WatchedSignals *watched, Trajectory *trajectory)
  {
    const TimeIntegrator &integrator = motion_.integrator();
    if (watched)
      observers_.push_back(
          std::make_unique<WatchedValues>(machine_, integrator, watched, coordinates_of(watched->signals)));
    if (trajectory)
      observers_.push_back(std::make_unique<TrajectoryKeeper>(*trajectory, machine_, integrator, sampling_.shortest));
    for (auto &check : run_checks(machine_, motion_, initial, options_, method_))
      observers_.push_back(std::move(check));
    motion_.watch(recorder_);
    motion_.watch(*this);
    for (const auto &observer : observers_)
      motion_.watch(*observer);
  }

  void integrate(const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                 const RunCheckpoints *checkpoints);
  void finish();

  /// The complete state for the rest of the run, and its records.
  std::string state()
  {
    StateArchive archive;
    archive(motion_, steps_);
    return archive.bytes();
  }

  /// Resumes from there instead of the start.
  /// @throws std::runtime_error if the state is that of another run
  void go_on(const std::string &state)
  {
    StateArchive archive(state);
    archive(motion_, steps_);
    if (!archive.at_end())
      throw std::runtime_error("the stored state is longer than that of this run");
  }

private:
  void event(const Event &event) override
  {
    if (std::string end = end_by_switch(machine_, options_.begin, event); !end.empty())
      result_.stop(ended_by_switch, event.name, std::move(end));
  }

  Machine                                  &machine_;
  const RunOptions                         &options_;
  const MethodOptions                      &method_;
  RunResult                                &result_;
  Motion                                    motion_;
  Sampling                                  sampling_;
  Recorder                                  recorder_;
  std::vector<std::unique_ptr<RunObserver>> observers_;
  long                                      steps_ = 1; ///< the next one
};

/// A step that cannot be made ends the run, with its reason in the result.
void Run::integrate(const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                    const RunCheckpoints *checkpoints)
{
  const long     progress_every = machine_.size() > 1000 ? 4 : 1024;
  CheckpointPace pace(checkpoints, [this] { return state(); });
  const auto     goes_on = [&]
  {
    if (!result_.failure.empty())
      return false;
    const bool pauses = steps_++ % progress_every == 0;
    if (pauses && progress)
      progress(motion_.time());
    result_.interrupted = stop && stop->load(std::memory_order_relaxed);
    if (result_.interrupted || (pauses && pace.is_due()))
      pace.keep();
    return !result_.interrupted;
  };
  try
  {
    motion_.to_end(goes_on);
  }
  catch (const ConvergenceFailure &failure)
  {
    result_.stop(failure.id(), failure.place(),
                 failure.what() + advice_on_failure(machine_, method_, motion_.integrator().instant()));
  }
}

void Run::finish()
{
  const TimeIntegrator &integrator = motion_.integrator();
  recorder_.finish(result_);
  result_.events    = motion_.driver().events();
  result_.end_state = integrator.instant().q;
  result_.stop("", "", non_finite_state_message(integrator.time(), result_.end_state, integrator.instant().v));
  static_cast<IntegrationWork &>(result_.work) = integrator.work();
  result_.work.chatter                         = motion_.chattering_steps();
  for (const auto &observer : observers_)
    observer->finish(result_);
}

} // namespace

RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop, Trajectory *trajectory)
{
  return simulate(machine, initial, options, signals, progress, stop, trajectory, nullptr);
}

RunResult simulate(Machine &machine, const InitialState &initial, const RunOptions &options,
                   const std::vector<Signal> &signals, const std::function<void(double)> &progress,
                   const std::atomic<bool> *stop, Trajectory *trajectory, const RunCheckpoints *checkpoints,
                   WatchedSignals *watched)
{
  const FlushDenormals while_it_runs;
  check_run(machine, options, signals.size());
  const auto [history, pictures, states] = kept_bytes(machine, options, signals.size());
  fem::require_available("the rows of history, and states for pictures and stresses,", history + pictures + states,
                         "Increase output.step, output.picture_step or output.stress.step.");
  machine.will_read(signals);
  const MethodOptions method = with_largest_step(machine, options);
  RunResult           result;
  result.accuracy       = check_start(machine, initial, options, method, result);
  const auto wall_start = std::chrono::steady_clock::now();
  result.method         = method_name(method);
  Run run(machine, options, method, signals, result);
  try
  {
    run.begin(initial);
    run.look_on(initial, watched, trajectory);
  }
  catch (const ConvergenceFailure &failure)
  {
    fail_at_start(failure, machine, result);
    return result;
  }
  if (checkpoints && !checkpoints->from.empty())
    run.go_on(checkpoints->from);
  run.integrate(progress, stop, checkpoints);
  run.finish();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  return result;
}

} // namespace gestell::coupling
