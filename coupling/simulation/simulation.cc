#include "coupling/simulation/simulation.h"

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/system/fastest_load.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/machine/configuration/constraint_rank.h"
#include "coupling/machine/element_law.h"
#include "coupling/simulation/checkpoint_pace.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/fast_forces.h"
#include "coupling/simulation/checks/gyroscopic_moments.h"
#include "coupling/simulation/checks/hydraulic_limits.h"
#include "coupling/simulation/checks/joint_force_guard.h"
#include "coupling/simulation/checks/momentary_modes.h"
#include "coupling/simulation/checks/stiffness_check.h"
#include "coupling/simulation/checks/unseen_forces.h"
#include "coupling/simulation/crawl_watch.h"
#include "coupling/simulation/kept_size.h"
#include "coupling/simulation/no_tiny_numbers.h"
#include "coupling/simulation/recorder.h"
#include "coupling/simulation/resumable_run.h"
#include "coupling/simulation/run_method.h"
#include "coupling/simulation/watched_values.h"
#include "fem/values/available_memory.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/point_contact.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double seldom            = 1e-4; ///< share of a run whose events need not be located
constexpr double often             = 0.1;  ///< share of controlled steps that go over events
constexpr double samples_of_period = 32.;

template <typename... Parts>
[[noreturn]] void refuse(const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// Fixed steps of implicit methods are short against what they show; controlled ones are as long as their order allows.
/// Exact propagation shows modes far above its step: 32 samples in a period show them.
Sampling sampling(const Machine &machine, const MethodOptions &method)
{
  Sampling sampling;
  sampling.inside = controlled(method);
  if (!method_of(method).carries_base())
    return sampling;
  for (const SpectrumLine &mode : machine.linear().spectrum())
    if (mode.omega > 0.)
      sampling.shortest = std::min(sampling.shortest, 2. * M_PI / (samples_of_period * mode.omega));
  // Up to 0.8 rad a step is as short against all modes as those of implicit methods.
  sampling.inside = sampling.inside || method.step > 4. * sampling.shortest;
  return sampling;
}

void take_work(const IntegrationWork &work, const EventDriver &driver, const RunOptions &options, RunResult &result)
{
  static_cast<IntegrationWork &>(result.work) = work;
  result.work.chatter                         = driver.chattering_steps();
  const double share                          = driver.chattering_time() / (options.end - options.begin);
  if (work.rejected > 0 && !controlled(options.method))
    result.warnings.push_back("Newton failed in " + std::to_string(work.rejected) + " steps; they were divided");
  if (result.work.chatter == 0)
    return;
  // Controlled steps that go over events still keep their tolerance.
  if (controlled(options.method) ? result.work.chatter < often * double(work.steps) : share < seldom)
    return;
  std::ostringstream text;
  text << "chatter: " << result.work.chatter << " steps, " << 100. * share
       << " % of the run, had more events than are located; they were gone over";
  result.warnings.push_back(text.str());
}

/// Refuses an unstable method, or tells of it if it was forced.
void guard(const Machine &machine, const InitialState &initial, const RunOptions &options, const MethodOptions &method,
           RunResult &result)
{
  const LinearSpectrum spectrum = spectrum_for(machine, initial, method);
  const StabilityGuard guard(spectrum, method);
  result.accuracy = guard.modes();
  result.warnings = guard.warnings();
  try
  {
    guard.check();
  }
  catch (const std::invalid_argument &unstable)
  {
    if (!options.force_unstable)
      throw;
    result.warnings.push_back(std::string("run.force_unstable: ") + unstable.what());
  }
}

void add(const std::vector<std::string> &warnings, std::vector<std::string> &all)
{
  all.insert(all.end(), warnings.begin(), warnings.end());
}

EventDriver event_driver(Machine &machine, TimeIntegrator &integrator, const RunOptions &options, double still)
{
  EventOptions events;
  events.locate = options.events;
  events.end    = options.end;
  events.still  = still;
  return {machine, integrator, events};
}

/// Of a run that did not get to its first instant nothing is known.
void fail_at_start(const ConvergenceFailure &failure, RunResult &result)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  result.failure        = std::string("the machine does not start: ") + failure.what();
  for (SignalSummary &signal : result.signals)
    signal.min = signal.t_min = signal.max = signal.t_max = signal.final = none;
}

/// What may lie behind a step that was not solved.
std::string advice(const Machine &machine, const MethodOptions &method, const Instant &last)
{
  std::string text;
  if (const std::string joint = ConstraintRank::at(machine, last.t, last.q).nearly_dependent(); !joint.empty())
    text += ".  The linkage is near a dead position, in which it may go two ways: " + joint +
            " is about to follow from the other joints; keep it off there, or make a joint compliant";
  bool rubs = false;
  for (const ElementPlacement &placement : machine.model().elements())
    rubs = rubs || law_of<mechanism::PointContact>(placement) || law_of<mechanism::JournalBearing>(placement);
  if (rubs && controlled(method))
    text += ".  If a contact with friction slides and sticks there, give its friction a larger 'speed', over which it "
            "develops, or take a fixed step";
  return text;
}

void warn_of_fast_loads(const Machine &machine, RunResult &result)
{
  const ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame || !(frame->frequency_limit_hz > 0.))
    return;
  const double fastest = fastest_load(machine.linear().excitation()) / (2. * M_PI);
  if (fastest <= frame->frequency_limit_hz)
    return;
  std::ostringstream text;
  text << "a load has " << fastest << " Hz, but the reduced frame is meant to hold up to " << frame->frequency_limit_hz
       << " Hz only: give reduction.frequency a larger value, or the model does not contain what this load excites";
  result.warnings.push_back(text.str());
}

} // namespace

void check_run(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  check_method(options.method);
  if (!(options.end > options.begin))
    refuse("run.end is ", options.end, " s; it must lie after the start at ", options.begin, " s");
  if (!(options.from < options.end))
    refuse("output.from is ", options.from,
           " s; extremes count from there on, so that it must lie before run.end = ", options.end, " s");
  if (!controlled(options.method) && !((options.end - options.begin) / options.method.step <= most_steps))
    refuse("run.step is ", options.method.step, " s; that makes more than 1e10 steps; take a longer one");
  require_steps_for_loads(machine, options.method);
  require_size(machine, options, n_signals);
}

void try_start(Machine &machine, const InitialState &initial, const RunOptions &options)
{
  const std::unique_ptr<TimeIntegrator> integrator = make_integrator(machine, with_largest_step(machine, options));
  event_driver(machine, *integrator, options, initial.still).begin(options.begin, initial.q, initial.v);
}

namespace
{

/// A run under way: the integrator, what drives it over events, what looks on.
class Run
{
public:
  Run(Machine &machine, const RunOptions &options, const MethodOptions &method, double still,
      const std::vector<Signal> &signals, RunResult &result)
      : machine_(machine), options_(options), method_(method), result_(result),
        integrator_(make_integrator(machine, method)), driver_(event_driver(machine, *integrator_, options, still)),
        recorder_(machine, *integrator_, options, signals, sampling(machine, method), result)
  {
  }

  /// @throws ConvergenceFailure if the machine does not start
  void begin(const InitialState &initial) { driver_.begin(options_.begin, initial.q, initial.v); }

  void look_on(const InitialState &initial, WatchedSignals *watched)
  {
    cylinders_   = std::make_unique<HydraulicLimits>(machine_, *integrator_);
    stiffness_   = std::make_unique<StiffnessCheck>(machine_, initial, method_);
    fast_forces_ = std::make_unique<FastForces>(machine_, *integrator_);
    joint_guard_ = std::make_unique<JointForceGuard>(machine_, *integrator_);
    momentary_   = std::make_unique<MomentaryModes>(machine_, options_.begin, options_.end);
    watched_     = std::make_unique<WatchedValues>(machine_, *integrator_, watched,
                                               watched ? coordinates_of(watched->signals) : std::vector<int>());
    driver_.on_step([this] { look_at_step(); });
    driver_.on_event(
        [this](const Event &event)
        {
          recorder_.jump(event.name);
          fast_forces_->jump();
          note_end(event);
        });
    recorder_.begin();
    cylinders_->begin();
    fast_forces_->begin();
    watched_->begin();
  }

  /// Keeps the motion, from the begin on.
  void keep(Trajectory &trajectory)
  {
    trajectory_ = &trajectory;
    spacing_    = sampling(machine_, method_).shortest;
    trajectory.begin(integrator_->instant(), machine_.events().save_history());
    driver_.on_guard([&](int guard) { trajectory.guard(guard); });
  }

  Run(const Run &)            = delete;
  Run &operator=(const Run &) = delete;

  void integrate(const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                 const RunCheckpoints *checkpoints);
  void finish(const InitialState &initial);

  /// All that the rest of the run depends on, and what was recorded.
  void exchange(StateArchive &archive)
  {
    driver_.exchange(archive);
    archive(recorder_, *cylinders_, *stiffness_, *fast_forces_, *joint_guard_, *momentary_, *watched_, crawl_, steps_);
  }

  std::string state()
  {
    StateArchive archive;
    exchange(archive);
    return archive.bytes();
  }

  /// Goes on from there instead of the begin.
  /// @throws std::runtime_error if the state is that of another run
  void go_on(const std::string &state)
  {
    StateArchive archive(state);
    exchange(archive);
    if (!archive.at_end())
      throw std::runtime_error("the stored state is longer than that of this run");
  }

private:
  void look_at_step()
  {
    recorder_.step();
    if (trajectory_)
      trajectory_->step(*integrator_, spacing_);
    cylinders_->step();
    if (!options_.force_unstable)
      stiffness_->step(integrator_->local());
    fast_forces_->step();
    joint_guard_->step();
    momentary_->step(integrator_->local());
    watched_->step();
  }

  void note_end(const Event &event)
  {
    if (end_.empty())
      end_ = end_by_switch(machine_, options_.begin, event);
  }

  Machine                         &machine_;
  const RunOptions                &options_;
  const MethodOptions             &method_;
  RunResult                       &result_;
  std::string                      end_; ///< statement of a switch that ends the run
  std::unique_ptr<TimeIntegrator>  integrator_;
  EventDriver                      driver_;
  Recorder                         recorder_;
  std::unique_ptr<HydraulicLimits> cylinders_;
  std::unique_ptr<StiffnessCheck>  stiffness_;
  std::unique_ptr<FastForces>      fast_forces_;
  std::unique_ptr<JointForceGuard> joint_guard_;
  std::unique_ptr<MomentaryModes>  momentary_;
  std::unique_ptr<WatchedValues>   watched_;
  CrawlWatch                       crawl_{options_};
  long                             steps_      = 1; ///< the next one
  Trajectory                      *trajectory_ = nullptr;
  double                           spacing_    = 0.; ///< [s] of its nodes
};

/// A step that cannot be made ends the run, with its reason in the result.
void Run::integrate(const std::function<void(double)> &progress, const std::atomic<bool> *stop,
                    const RunCheckpoints *checkpoints)
{
  const long     progress_every = machine_.size() > 1000 ? 4 : 1024;
  const double   finish         = options_.end - 1e-12 * (options_.end - options_.begin); // what rounding may leave
  CheckpointPace pace(checkpoints, [this] { return state(); });
  try
  {
    for (; integrator_->time() < finish; ++steps_)
    {
      driver_.advance();
      if (!end_.empty())
      {
        result_.failure = end_;
        break;
      }
      const bool pauses = steps_ % progress_every == 0;
      if (pauses && progress)
        progress(integrator_->time());
      if (steps_ % CrawlWatch::window == 0 && controlled(method_))
        crawl_.look(integrator_->time());
      if (stop && stop->load(std::memory_order_relaxed))
      {
        result_.interrupted = true;
        ++steps_;
        pace.keep();
        break;
      }
      if (pauses && pace.is_due())
      {
        ++steps_;
        pace.keep();
        --steps_;
      }
    }
  }
  catch (const ConvergenceFailure &failure)
  {
    result_.failure = failure.what() + advice(machine_, method_, integrator_->instant());
  }
}

void Run::finish(const InitialState &initial)
{
  recorder_.finish();
  result_.events    = driver_.events();
  result_.end_state = integrator_->instant().q;
  watched_->finish();
  if (result_.failure.empty())
    result_.failure = no_number_words(integrator_->time(), result_.end_state, integrator_->instant().v);
  add(switch_warnings(machine_, options_.begin, result_.events, result_.failure.empty() && !result_.interrupted),
      result_.warnings);
  take_work(integrator_->work(), driver_, options_, result_);
  const Eigen::VectorXd   &v        = integrator_->instant().v;
  std::vector<std::string> warnings = cylinders_->warnings();
  for (std::string warning : {fast_forces_->warning(), momentary_->warning()})
    if (!warning.empty())
      warnings.push_back(std::move(warning));
  const Eigen::VectorXd &fastest = v.norm() > initial.v.norm() ? v : initial.v;
  add(tilting_rotors(machine_, fastest), warnings);
  add(unseen_forces(machine_, method_, options_.begin, integrator_->local(), fastest), warnings);
  add(warnings, result_.warnings);
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
  const NoTinyNumbers while_it_runs;
  check_run(machine, options, signals.size());
  const auto [history, pictures, states] = kept_bytes(machine, options, signals.size());
  fem::require_available("the rows of history, and states for pictures and stresses,", history + pictures + states,
                         "Give output.step, output.picture_step or output.stress.step a larger value.");
  machine.will_read(signals);
  const MethodOptions method = with_largest_step(machine, options);
  RunResult           result;
  guard(machine, initial, options, method, result);
  const auto wall_start = std::chrono::steady_clock::now();
  result.method         = method_name(method);
  warn_of_fast_loads(machine, result);
  add(initial.notes, result.warnings);
  if (!initial.settled)
    add(closed_contact_warnings(machine, initial), result.warnings);
  if (!options.events)
    add(unlocated_friction_warnings(machine), result.warnings);
  Run run(machine, options, method, initial.still, signals, result);
  try
  {
    run.begin(initial);
  }
  catch (const ConvergenceFailure &failure)
  {
    fail_at_start(failure, result);
    return result;
  }
  run.look_on(initial, watched);
  if (trajectory)
    run.keep(*trajectory);
  if (checkpoints && !checkpoints->from.empty())
    run.go_on(checkpoints->from);
  run.integrate(progress, stop, checkpoints);
  run.finish(initial);
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  return result;
}

} // namespace gestell::coupling
