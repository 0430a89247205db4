#include "coupling/simulation/checks/run_checks.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/fastest_load.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/machine/configuration/constraint_rank.h"
#include "coupling/machine/element_law.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "coupling/simulation/checks/force_bandwidth_check.h"
#include "coupling/simulation/checks/gyroscopic_moments.h"
#include "coupling/simulation/checks/instantaneous_modes.h"
#include "coupling/simulation/checks/joint_force_guard.h"
#include "coupling/simulation/checks/piston_limits.h"
#include "coupling/simulation/checks/step_collapse_guard.h"
#include "coupling/simulation/checks/step_resolution_check.h"
#include "coupling/simulation/checks/stiffness_check.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/point_contact.h"
#include "mechanism/user_force.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Reports switches that acted at the start, or never.
class SwitchCheck : public RunObserver
{
public:
  SwitchCheck(const Machine &machine, double begin) : machine_(machine), begin_(begin) {}

  void event(const Event &event) override
  {
    const auto same = [&](const Event &other) { return other.name == event.name; };
    if (event.kind == "switch" && std::none_of(thrown_.begin(), thrown_.end(), same))
      thrown_.push_back(event);
  }
  void finish(RunOutcome &outcome) override { check_switches(machine_, begin_, thrown_, outcome); }
  void exchange(StateArchive &archive) override { archive(thrown_); }

private:
  const Machine     &machine_;
  double             begin_;
  std::vector<Event> thrown_; ///< the first time of each
};

/// Reports steps that were divided, and steps with more events than are located.
class WorkCheck : public RunObserver
{
public:
  WorkCheck(const Motion &motion, const RunOptions &options) : motion_(motion), options_(options) {}

  void begin() override
  {
    ++starts_;
    before_ = counts();
  }
  void step() override { count(); }
  void finish(RunOutcome &outcome) override
  {
    count();
    const Counts &total = total_;
    if (total[rejected] > 0. && !controlled(options_.method))
      outcome.warn("divided-steps", "run.step",
                   "Newton's method failed in " + std::to_string(long(total[rejected])) + " steps, which were divided");
    const double     share          = total[chatter_time] / (std::max(options_.end, motion_.time()) - options_.begin);
    constexpr double seldom_skipped = 1e-4; // share of a run whose events need not be located
    constexpr double often_skipped  = 0.1;  // share of controlled steps that skip events
    // Controlled steps that skip events still keep their tolerance.
    if (total[chatter] == 0. ||
        (controlled(options_.method) ? total[chatter] < often_skipped * total[steps] : share < seldom_skipped))
      return;
    std::ostringstream text;
    text << "chatter: " << long(total[chatter]) << " steps, " << 100. * share
         << " % of the run, had too many events to locate; these events were not located";
    outcome.warn("chatter", "run.events", text.str());
  }
  /// The counters of the integrator continue where its motion restarted: counts of the discarded motion are removed.
  void exchange(StateArchive &archive) override
  {
    long starts = starts_;
    archive(total_, before_, starts);
    if (archive.reads() && starts != starts_)
      before_ = counts();
  }

private:
  enum Counter
  {
    rejected,
    steps,
    chatter,
    chatter_time,
    n_counters
  };
  using Counts = std::array<double, n_counters>;

  Counts counts() const
  {
    const IntegrationWork &work = motion_.integrator().work();
    return {double(work.rejected), double(work.steps), double(motion_.chattering_steps()), motion_.chattering_time()};
  }
  void count()
  {
    const Counts now = counts();
    for (int i = 0; i < n_counters; ++i)
      total_[i] += now[i] - before_[i];
    before_ = now;
  }

  long             starts_ = 0; ///< of the motion
  Counts           total_{}, before_{};
  const Motion    &motion_;
  const RunOptions options_;
};

/// Checks that need the end: the speeds of rotors, and forces compared with the steps made.
class EndCheck : public RunObserver
{
public:
  EndCheck(Machine &machine, const Motion &motion, Eigen::VectorXd v_begin, double begin, const MethodOptions &method)
      : machine_(machine), motion_(motion), v_begin_(std::move(v_begin)), begin_(begin), method_(method)
  {
  }

  void finish(RunOutcome &outcome) override
  {
    const Eigen::VectorXd &v = motion_.integrator().instant().v, &fastest = v.norm() > v_begin_.norm() ? v : v_begin_;
    check_tilting_rotors(machine_, fastest, outcome);
    check_step_resolution(machine_, method_, begin_, motion_.integrator().local(), fastest, outcome);
  }

private:
  Machine        &machine_;
  const Motion   &motion_;
  Eigen::VectorXd v_begin_;
  double          begin_;
  MethodOptions   method_;
};

void check_stability(const Machine &machine, const InitialState &initial, const RunOptions &options,
                     const MethodOptions &method, RunOutcome &outcome, std::vector<ModeAccuracy> &modes)
{
  const LinearSpectrum spectrum = spectrum_for(machine, initial, method);
  const StabilityGuard guard(spectrum, method);
  modes = guard.modes();
  for (std::string &warning : guard.warnings())
    outcome.warn("contact-stability", "run.step", std::move(warning));
  try
  {
    guard.check();
  }
  catch (const std::invalid_argument &unstable)
  {
    if (!options.force_unstable)
      throw;
    outcome.warn("stability", "run.step", std::string("run.force_unstable: ") + unstable.what());
  }
}

void check_fast_loads(const Machine &machine, RunOutcome &outcome)
{
  const ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame || !(frame->frequency_limit_hz > 0.))
    return;
  const double fastest = fastest_load(machine.linear().excitation()) / (2. * M_PI);
  if (fastest <= frame->frequency_limit_hz)
    return;
  std::ostringstream text;
  text << "a load has " << fastest << " Hz, but the frequency limit of the reduced frame is "
       << frame->frequency_limit_hz
       << " Hz, so the model omits modes that this load excites; increase reduction.frequency";
  outcome.warn("load-frequency", "reduction.frequency", text.str());
}

} // namespace

std::vector<ModeAccuracy> check_start(const Machine &machine, const InitialState &initial, const RunOptions &options,
                                      const MethodOptions &method, RunOutcome &outcome)
{
  std::vector<ModeAccuracy> modes;
  check_stability(machine, initial, options, method, outcome, modes);
  check_fast_loads(machine, outcome);
  for (const std::string &note : initial.notes)
    outcome.warn("start", "start", note);
  if (!initial.settled)
    check_closed_contacts(machine, initial, outcome);
  if (!options.events)
    check_unlocated_friction(machine, outcome);
  return modes;
}

std::vector<std::unique_ptr<RunObserver>> run_checks(Machine &machine, const Motion &motion,
                                                     const InitialState &initial, const RunOptions &options,
                                                     const MethodOptions &method)
{
  const TimeIntegrator                     &integrator = motion.integrator();
  std::vector<std::unique_ptr<RunObserver>> checks;
  checks.push_back(std::make_unique<SwitchCheck>(machine, options.begin));
  checks.push_back(std::make_unique<WorkCheck>(motion, options));
  checks.push_back(std::make_unique<PistonLimits>(machine, integrator));
  if (!options.force_unstable)
    checks.push_back(std::make_unique<StiffnessCheck>(machine, integrator, initial, method));
  checks.push_back(std::make_unique<ForceBandwidthCheck>(machine, integrator));
  checks.push_back(std::make_unique<JointForceGuard>(machine, integrator));
  checks.push_back(std::make_unique<InstantaneousModes>(machine, integrator, options.begin, options.end));
  if (controlled(method))
    checks.push_back(std::make_unique<StepCollapseGuard>(integrator, options));
  checks.push_back(std::make_unique<EndCheck>(machine, motion, initial.v, options.begin, method));
  return checks;
}

std::string faults_of(const Machine &machine, double t)
{
  std::string text;
  for (const ElementPlacement &placement : machine.model().elements())
    if (const auto *law = law_of<mechanism::UserForce>(placement))
      if (const std::string fault = law->fault(t); !fault.empty())
        text += ". In \"" + placement.name + "\" " + fault;
  return text;
}

std::string advice_on_failure(const Machine &machine, const MethodOptions &method, const Instant &last)
{
  std::string text = faults_of(machine, last.t);
  if (!text.empty())
    return text;
  if (const std::string joint = ConstraintRank::at(machine, last.t, last.q).nearly_dependent(); !joint.empty())
    text += ". The linkage is near a dead-centre position with two possible motions: " + joint +
            " becomes redundant; avoid this position, or make a joint compliant";
  bool rubs = false;
  for (const ElementPlacement &placement : machine.model().elements())
    rubs = rubs || law_of<mechanism::PointContact>(placement) || law_of<mechanism::JournalBearing>(placement);
  if (rubs && controlled(method))
    text += ". If a contact with friction slides and sticks there, increase the 'speed' of its friction, or use a "
            "fixed step";
  return text;
}

} // namespace gestell::coupling
