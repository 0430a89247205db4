#include "apps/cli/chart/work_measurement.h"

#include "coupling/integration/events/motion.h"
#include "coupling/simulation/recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{
namespace
{

/// Takes the samples of a run from the dense output of each step.
class Sampler : public coupling::RunObserver
{
public:
  Sampler(const WorkProblem &problem, const coupling::TimeIntegrator &integrator)
      : problem_(problem), integrator_(integrator), coordinates_(coupling::coordinates_of(problem.signals)),
        accelerations_(coupling::accelerations_for(problem.signals, problem.machine)),
        q_(Eigen::VectorXd::Zero(problem.machine.size())), v_(q_),
        values_(problem.signals.size(), problem.samples.size())
  {
    local_.resize(problem.machine);
  }

  void step() override
  {
    constexpr double rounding = 1e-12; // rounding of the last step, relative to the run
    const double     now = integrator_.time(), slack = rounding * (problem_.samples.back() - problem_.begin);
    for (; next_ < problem_.samples.size() && problem_.samples[next_] <= now + slack; ++next_)
    {
      const double t      = std::min(problem_.samples[next_], now);
      const bool   at_end = t == now;
      if (!at_end)
        integrator_.interpolate(t, local_);
      const coupling::LocalState &local = at_end ? integrator_.local() : local_;
      if (accelerations_)
        a_ = accelerations_->at(t, integrator_, local, q_, v_);
      else if (!coordinates_.empty())
        integrator_.motion_at(t, coordinates_, q_, v_);
      for (std::size_t i = 0; i < problem_.signals.size(); ++i)
        values_(i, next_) = problem_.machine.evaluate(problem_.signals[i], q_, v_, a_, local);
    }
  }

  bool          complete() const { return next_ == problem_.samples.size(); }
  SignalSamples values() const { return values_; }

private:
  const WorkProblem                     &problem_;
  const coupling::TimeIntegrator        &integrator_;
  std::vector<int>                       coordinates_;
  std::optional<coupling::Accelerations> accelerations_;
  Eigen::VectorXd                        q_, v_, a_;
  coupling::LocalState                   local_;
  SignalSamples                          values_;
  std::size_t                            next_ = 0;
};

/// Steps to the end; why it did not get there, or nothing.
std::string step_to_end(const WorkProblem &problem, coupling::Motion &motion)
{
  const double began = peers::thread_seconds();
  std::string  failure;
  long         k       = 0;
  const auto   goes_on = [&]
  {
    if (++k % 256 != 0)
      return true;
    if (peers::thread_seconds() - began > problem.cpu_limit)
      failure = "more than " + std::to_string(int(problem.cpu_limit)) + " s of CPU time";
    else if (problem.stop && problem.stop->load(std::memory_order_relaxed))
      failure = "interrupted";
    return failure.empty();
  };
  try
  {
    motion.to_end(goes_on);
  }
  catch (const coupling::ConvergenceFailure &stopped)
  {
    return stopped.what();
  }
  return failure;
}

enum class Sampling
{
  off,
  on
};

WorkRun run_once(const WorkProblem &problem, const coupling::MethodOptions &method, bool events, Sampling sampling)
{
  WorkRun          run;
  const double     began = peers::thread_seconds();
  coupling::Motion motion(problem.machine, coupling::make_integrator(problem.machine, method));
  try
  {
    motion.begin(problem.begin, problem.initial.q, problem.initial.v, {events, problem.samples.back()});
  }
  catch (const coupling::ConvergenceFailure &failure)
  {
    run.failure = failure.what();
    return run;
  }
  Sampler sampler(problem, motion.integrator());
  if (sampling == Sampling::on)
    motion.watch(sampler);
  const double ready = peers::thread_seconds();
  run.failure        = step_to_end(problem, motion);
  run.cpu_s          = peers::thread_seconds() - ready;
  run.setup_s        = ready - began;
  run.work           = motion.integrator().work();
  run.events         = long(motion.driver().events().size());
  if (sampling == Sampling::off || !run.failure.empty())
    return run;
  if (sampler.complete())
    run.values = sampler.values();
  else
    run.failure = "the run ended before its last sample";
  return run;
}

/// Times a run without samples, short ones several times, and keeps the shortest times: the cost of reading thousands
/// of samples is not part of the method.
template <typename Once>
void time_unsampled(const WorkProblem &problem, WorkRun &run, const Once &once)
{
  double        spent        = 0.;
  constexpr int most_repeats = 5; // other programs disturb the shortest of some times least
  for (int k = 0; k < most_repeats && run.failure.empty() && spent < problem.repeat_s; ++k)
  {
    const WorkRun again = once();
    if (!again.failure.empty())
      return;
    run.cpu_s   = k == 0 ? again.cpu_s : std::min(run.cpu_s, again.cpu_s);
    run.setup_s = std::min(run.setup_s, again.setup_s);
    spent += again.cpu_s;
  }
}

/// The samples of a peer turned into signals, after the run.
SignalSamples signals_of(const WorkProblem &problem, const peers::PeerResult &result, bool events)
{
  coupling::Machine    &machine = problem.machine;
  const auto           &W       = machine.forces().directions();
  const Eigen::VectorXd kept    = machine.events().save_history();
  coupling::LocalState  local;
  SignalSamples         values(problem.signals.size(), result.samples.size());
  auto                  accelerations = coupling::accelerations_for(problem.signals, machine);
  Eigen::VectorXd       a;
  local.resize(machine);
  machine.events().follow_history(events);
  for (std::size_t k = 0; k < result.samples.size(); ++k)
  {
    const peers::MotionSample &sample = result.samples[k];
    machine.events().restore_history(sample.history);
    local.t = sample.t;
    local.u = W.transpose() * sample.q;
    local.v = W.transpose() * sample.v;
    local.p = sample.p;
    if (accelerations)
      a = accelerations->at(sample.q, sample.v, local);
    for (std::size_t i = 0; i < problem.signals.size(); ++i)
      values(i, k) = machine.evaluate(problem.signals[i], sample.q, sample.v, a, local);
  }
  machine.events().restore_history(kept);
  return values;
}

/// Largest coordinates and velocities at the samples.
class ScaleObserver : public coupling::RunObserver
{
public:
  ScaleObserver(const WorkProblem &problem, const coupling::TimeIntegrator &integrator, MotionScales &scales)
      : problem_(problem), integrator_(integrator), scales_(scales), q_(problem.machine.size()), v_(q_)
  {
  }

  void step() override
  {
    for (; next_ < problem_.samples.size() && problem_.samples[next_] <= integrator_.time(); ++next_)
    {
      integrator_.interpolate(problem_.samples[next_], q_, v_);
      scales_.q = scales_.q.cwiseMax(q_.cwiseAbs());
      scales_.v = scales_.v.cwiseMax(v_.cwiseAbs());
    }
  }

private:
  const WorkProblem              &problem_;
  const coupling::TimeIntegrator &integrator_;
  MotionScales                   &scales_;
  Eigen::VectorXd                 q_, v_;
  std::size_t                     next_ = 0;
};

/// One scale for all coordinates of one kind.
void share_scale(Eigen::VectorXd &x, const std::vector<int> &kind)
{
  double largest = 0.;
  for (const int i : kind)
    largest = std::max(largest, x[i]);
  for (const int i : kind)
    x[i] = largest > 0. ? largest : 1.;
}

} // namespace

double longest_step(const WorkProblem &problem)
{
  double longest = (problem.samples.back() - problem.begin) / 50.;
  for (const auto &harmonic : problem.machine.linear().excitation().harmonics())
    longest = std::min(longest, 0.25 * M_PI / harmonic.omega);
  return longest;
}

double scaled_error(const SignalSamples &values, const SignalSamples &reference)
{
  if (values.rows() != reference.rows() || values.cols() != reference.cols() || !values.allFinite())
    return std::numeric_limits<double>::infinity();
  double       sum  = 0.;
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < reference.rows(); ++i)
  {
    const double scale = reference.row(i).cwiseAbs().maxCoeff();
    if (!(scale > 0.))
      continue;
    sum += (values.row(i) - reference.row(i)).squaredNorm() / (scale * scale);
    ++kept;
  }
  return kept > 0 ? std::sqrt(sum / double(kept * reference.cols())) : 0.;
}

WorkRun measure(const WorkProblem &problem, const coupling::MethodOptions &method, bool events)
{
  WorkRun run = run_once(problem, method, events, Sampling::on);
  time_unsampled(problem, run, [&] { return run_once(problem, method, events, Sampling::off); });
  return run;
}

WorkRun measure(const WorkProblem &problem, const peers::PeerOptions &options, const MotionScales &scales)
{
  const auto once = [&](const std::vector<double> &samples)
  {
    peers::PeerProblem peer;
    peer.t       = problem.begin;
    peer.q       = problem.initial.q;
    peer.v       = problem.initial.v;
    peer.q_scale = scales.q;
    peer.v_scale = scales.v;
    peer.samples = samples;
    peer.stop    = problem.stop;
    return peers::run_peer(problem.machine, peer, options);
  };
  const auto reported = [&](const peers::PeerResult &result)
  {
    WorkRun run;
    run.work    = result.work;
    run.events  = result.events;
    run.cpu_s   = result.cpu_s;
    run.setup_s = result.setup_s;
    run.failure = result.failure;
    return run;
  };
  const peers::PeerResult first = once(problem.samples);
  WorkRun                 run   = reported(first);
  if (run.failure.empty())
    run.values = signals_of(problem, first, options.events);
  time_unsampled(problem, run, [&] { return reported(once({problem.samples.back()})); });
  return run;
}

MotionScales motion_scales(const WorkProblem &problem, const coupling::MethodOptions &method, bool events)
{
  coupling::Motion motion(problem.machine, coupling::make_integrator(problem.machine, method));
  motion.begin(problem.begin, problem.initial.q, problem.initial.v, {events, problem.samples.back()});
  MotionScales  scales{problem.initial.q.cwiseAbs(), problem.initial.v.cwiseAbs()};
  ScaleObserver observer(problem, motion.integrator(), scales);
  motion.watch(observer);
  step_to_end(problem, motion);

  // Modes together; the interface by units; each body separately, because a flywheel rotates far.
  const coupling::Machine &machine     = problem.machine;
  const int                n_interface = machine.model().n_interface();
  std::vector<int>         metres, radians, modes;
  for (int i = 0; i < machine.model().n_frame(); ++i)
  {
    const std::string name = machine.coordinate_name(i);
    if (i >= n_interface)
      modes.push_back(i);
    else
      (name.size() > 3 && name.compare(name.size() - 3, 2, ".r") == 0 ? radians : metres).push_back(i);
  }
  for (int i = machine.model().n_frame(); i < machine.size(); ++i)
    for (Eigen::VectorXd *x : {&scales.q, &scales.v})
      share_scale(*x, {i});
  for (const auto *kind : {&metres, &radians, &modes})
    for (Eigen::VectorXd *x : {&scales.q, &scales.v})
      share_scale(*x, *kind);
  return scales;
}

} // namespace gestell::apps
