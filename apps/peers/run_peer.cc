#include "apps/peers/peer.h"
#include "apps/peers/stepper.h"
#include "coupling/integration/events/event_detection.h"

#include <algorithm>

namespace gestell::peers
{
namespace
{

using coupling::GuardCrossing;

void require(bool condition, const std::string &message)
{
  if (!condition)
    throw std::invalid_argument("peers: " + message);
}

bool order_is_known(const PeerOptions &options)
{
  const int p = options.order;
  switch (options.kind)
  {
  case PeerKind::cvode_adams:
    return p >= 1 && p <= 12;
  case PeerKind::explicit_rk:
    return p >= 3 && p <= 8 && p != 7;
  case PeerKind::petsc_bdf:
    return p >= 1 && p <= 6;
  case PeerKind::petsc_alpha:
    return true;
  default:
    return p >= 1 && p <= 5;
  }
}

void check(const coupling::SecondOrderSystem &system, const PeerProblem &problem, const PeerOptions &options)
{
  const int n = system.linear().size();
  for (const Eigen::VectorXd *x : {&problem.q, &problem.v, &problem.q_scale, &problem.v_scale})
    require(x->size() == n,
            "vectors of " + std::to_string(x->size()) + " numbers for " + std::to_string(n) + " coordinates.");
  require((problem.q_scale.array() > 0.).all() && (problem.v_scale.array() > 0.).all(),
          "every coordinate needs a positive scale.");
  require(options.tolerance > 0. && options.tolerance < 1., "the tolerance must be between 0 and 1.");
  require(!problem.samples.empty() && std::is_sorted(problem.samples.begin(), problem.samples.end()) &&
              problem.samples.front() >= problem.t,
          "the instants of the samples must ascend from the start.");
  const bool petsc = options.kind == PeerKind::petsc_bdf || options.kind == PeerKind::petsc_alpha;
  require(order_is_known(options),
          "order " + std::to_string(options.order) +
              "; BDF has 1 to 5 (PETSc 6), Adams 1 to 12, explicit Runge-Kutta 3, 4, 5, 6 or 8.");
  require((options.kind == PeerKind::petsc_alpha) == (options.step > 0.),
          "PETSc alpha2 needs a fixed step; all others control their step.");
  require(!petsc || !options.events, "PETSc does not locate events; switch them off.");
  require(!petsc || options.solver == PeerSolver::condensed, "PETSc supports the condensed solver only.");
}

std::unique_ptr<Stepper> make_stepper(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  switch (options.kind)
  {
  case PeerKind::ida:
    return make_ida(callbacks, problem, options);
  case PeerKind::explicit_rk:
    return make_explicit_rk(callbacks, problem, options);
  case PeerKind::petsc_bdf:
  case PeerKind::petsc_alpha:
    return make_petsc(callbacks, problem, options);
  default:
    return make_cvode(callbacks, problem, options);
  }
}

/// Leads a library through time and keeps the history of the elements as EventDriver does for our own methods.
class PeerRun
{
public:
  PeerRun(coupling::SecondOrderSystem &system, const PeerProblem &problem, const PeerOptions &options)
      : system_(system), problem_(problem), options_(options), form_(system),
        detection_(system), callbacks_{form_, [this](double t, const double *y, double *g) { guards_at(t, y, g); }},
        n_(system.linear().size()), y_(2 * n_), restart_y_(2 * n_)
  {
    for (coupling::LocalState *local : {&before_, &now_, &between_})
      local->resize(system);
    y_ << problem.q, problem.v;
    if (options.solver == PeerSolver::dense && options.kind != PeerKind::explicit_rk)
      form_.know_dense();
  }

  void go(PeerResult &result)
  {
    begin();
    stepper_ = make_stepper(callbacks_, problem_, options_);
    watch();
    before_guards();
    const double ready = thread_seconds();
    result.setup_s     = ready - began_;
    step_to_end(ready, result);
    result.cpu_s = thread_seconds() - ready;
    result.work  = form_.work();
    stepper_->count(result.work);
    result.events = n_events_ + long(passed_.size());
  }

private:
  void step_to_end(double ready, PeerResult &result)
  {
    sample(problem_.t, y_.data(), result);
    for (long k = 1; result.samples.size() < problem_.samples.size(); ++k)
    {
      const Stepper::Outcome outcome = stepper_->step();
      if (outcome == Stepper::Outcome::failed)
      {
        result.failure = stepper_->failure();
        break;
      }
      if (k % 64 == 0 && limit_reached(ready, result))
        break;
      if (options_.events && overdue())
        continue;
      while (result.samples.size() < problem_.samples.size() &&
             problem_.samples[result.samples.size()] <= stepper_->time())
      {
        const double t = problem_.samples[result.samples.size()];
        stepper_->interpolate(t, y_.data());
        sample(t, y_.data(), result);
      }
      accept(outcome == Stepper::Outcome::root);
    }
  }

  bool limit_reached(double ready, PeerResult &result) const
  {
    if (thread_seconds() - ready > options_.cpu_limit)
      result.failure = "more than " + std::to_string(int(options_.cpu_limit)) + " s of CPU time";
    else if (problem_.stop && problem_.stop->load(std::memory_order_relaxed))
      result.failure = "interrupted";
    return !result.failure.empty();
  }

  void begin()
  {
    motion(problem_.t, y_.data(), before_);
    system_.events().follow_history(false);
    system_.events().start(before_);
    system_.events().follow_history(options_.events);
    form_.local_state(problem_.t, y_.data(), before_);
    detection_.begin(before_);
  }

  void motion(double t, const double *y, coupling::LocalState &local) const
  {
    const auto &W     = system_.forces().directions();
    local.t           = t;
    local.u.noalias() = W.transpose() * Eigen::Map<const Eigen::VectorXd>(y, n_);
    local.v.noalias() = W.transpose() * Eigen::Map<const Eigen::VectorXd>(y + n_, n_);
  }

  void guards_at(double t, const double *y, double *g)
  {
    form_.local_state(t, y, between_);
    g_.resize(system_.events().n_guards());
    system_.events().guard_values(between_, g_);
    std::copy(g_.data(), g_.data() + g_.size(), g);
  }

  void sample(double t, const double *y, PeerResult &result)
  {
    if (result.samples.size() >= problem_.samples.size() || problem_.samples[result.samples.size()] != t)
      return;
    form_.local_state(t, y, between_);
    result.samples.push_back({t, Eigen::Map<const Eigen::VectorXd>(y, n_),
                              Eigen::Map<const Eigen::VectorXd>(y + n_, n_), system_.events().save_history(),
                              between_.p});
  }

  void watch()
  {
    if (!options_.events)
      return;
    std::vector<int> directions;
    for (int i = 0; i < system_.events().n_guards(); ++i)
      directions.push_back(system_.events().crossing(i) == GuardCrossing::rising ? 1 : -1);
    stepper_->watch(directions);
  }

  void accept(bool root)
  {
    if (!options_.events)
    {
      motion(stepper_->time(), stepper_->state(), now_);
      detection_.step(before_, now_, passed_);
      system_.events().accept(now_);
      std::swap(before_, now_);
      return;
    }
    form_.local_state(stepper_->time(), stepper_->state(), now_);
    system_.events().accept(now_);
    if (root)
    {
      y_ = Eigen::Map<const Eigen::VectorXd>(stepper_->state(), 2 * n_);
      transition(stepper_->root(), stepper_->time(), now_);
    }
  }

  void transition(int guard, double t, const coupling::LocalState &local)
  {
    system_.events().transition(guard, local);
    ++n_events_;
    stepper_->restart(t, y_.data());
    watch();
    before_guards();
  }

  /// Stores the guards (event functions) at a start, where the library does not search for roots.
  void before_guards()
  {
    if (!options_.events)
      return;
    restart_y_ = y_;
    restart_t_ = stepper_->time();
    guards_at(restart_t_, restart_y_.data(), (start_guards_.resize(system_.events().n_guards()), start_guards_.data()));
    fresh_ = true;
  }

  /// A guard past zero at a start that stays so is due there, not later: the step is given back.
  bool overdue()
  {
    if (!fresh_)
      return false;
    fresh_ = false;
    end_guards_.resize(system_.events().n_guards());
    guards_at(stepper_->time(), stepper_->state(), end_guards_.data());
    for (int i = 0; i < int(start_guards_.size()); ++i)
    {
      const double s = system_.events().crossing(i) == GuardCrossing::rising ? 1. : -1.;
      if (s * start_guards_[i] >= 0. && s * end_guards_[i] > 0.)
      {
        y_ = restart_y_;
        form_.local_state(restart_t_, y_.data(), now_);
        transition(i, restart_t_, now_);
        return true;
      }
    }
    return false;
  }

  const double                 began_ = thread_seconds();
  coupling::SecondOrderSystem &system_;
  const PeerProblem           &problem_;
  const PeerOptions           &options_;
  FirstOrderForm               form_;
  coupling::EventDetection     detection_;
  Callbacks                    callbacks_;
  std::unique_ptr<Stepper>     stepper_;
  const int                    n_;
  Eigen::VectorXd              y_, restart_y_, g_;
  coupling::LocalState         before_, now_, between_;
  std::vector<coupling::Event> passed_;
  std::vector<double>          start_guards_, end_guards_;
  double                       restart_t_ = 0.;
  bool                         fresh_     = false; ///< no step since the last start
  long                         n_events_  = 0;
};

} // namespace

PeerResult run_peer(coupling::SecondOrderSystem &system, const PeerProblem &problem, const PeerOptions &options)
{
  check(system, problem, options);
  PeerResult result;
  try
  {
    PeerRun(system, problem, options).go(result);
  }
  catch (const coupling::ConvergenceFailure &failure)
  {
    result.failure = failure.what();
  }
  return result;
}

} // namespace gestell::peers
