#include "coupling/periodic/collocation/collocation_branch.h"

#include "coupling/periodic/collocation/mesh_search.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double      mesh_tolerance  = 1e-8; ///< of PeriodicCollocation::errors()
constexpr double      another         = 1e-6; ///< distance of two mesh points, in periods: far below an interval
constexpr std::size_t least_intervals = 16;   ///< of a period: a harmonic of order 4 has four intervals a swing
/// of the place of an event in the length of z: motions count there, not places
constexpr double small_share = 1e-3;

bool equal(const std::vector<double> &a, const std::vector<double> &b, double moved)
{
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [moved](double x, double y) { return std::abs(x - y) <= moved; });
}

/// The points of `mesh` when some of them, `from`, come to `to` and those between keep their share of the way.
std::vector<double> stretched(std::vector<double> mesh, std::vector<double> from, std::vector<double> to)
{
  for (std::vector<double> *points : {&from, &to})
  {
    points->insert(points->begin(), 0.);
    points->push_back(1.);
  }
  for (double &s : mesh)
  {
    const auto   beyond = std::upper_bound(from.begin(), from.end(), s) - from.begin();
    const auto   k      = std::size_t(std::clamp<std::ptrdiff_t>(beyond, 1, std::ptrdiff_t(from.size()) - 1));
    const double way = from[k] - from[k - 1], share = way > 0. ? (s - from[k - 1]) / way : 0.;
    s = to[k - 1] + share * (to[k] - to[k - 1]);
  }
  return mesh;
}

const std::string by_shooting = ", beyond which the mesh cannot follow it; use --method shooting";

/// z = (y of PeriodicCollocation, weighted; places of the events in the mesh).  Newton's method leaves the places as
/// they are: F is zero in their rows.  follow_motion() moves them.
class CollocationBranch final : public BranchEquations
{
public:
  CollocationBranch(ProblemFamily family, const PeriodicOptions &options, int ratio)
      : family_(std::move(family)), options_(options), ratio_(ratio)
  {
    if (!options_.integration.modes)
      options_.integration.modes = std::make_shared<SharedModes>();
  }

  VectorXd unknowns(const PeriodicSolution &solution, double lambda) override
  {
    form(lambda, solution.period);
    if (mesh_.empty())
      begin_mesh(solution);
    const std::vector<double> events = event_points(solution.events, solution.begin, solution.period);
    if (events.size() == events_.size())
      move_events(events);
    return packed(unknowns_of(solution));
  }

  void evaluate(const VectorXd &z, double lambda, bool jacobian) override
  {
    const Index n = weights_.size(), m = z.size();
    y_ = z.head(n).cwiseQuotient(weights_);
    if (member_.problem.period_is_unknown() && !(y_.tail(1)[0] > 0.))
      throw ConvergenceFailure("Newton's method gives a period that is not positive");
    form(lambda, y_.tail(1)[0]);
    const VectorXd places = z.tail(m - n) / event_scale_;
    move_events(std::vector<double>(places.begin(), places.end()));
    VectorXd r;
    if (jacobian)
    {
      MatrixXd J;
      collocation_->linearise(y_, r, J);
      jacobian_                     = MatrixXd::Identity(m, m);
      jacobian_.topLeftCorner(n, n) = -(weights_.asDiagonal() * J * weights_.cwiseInverse().asDiagonal());
    }
    else
      collocation_->residual(y_, r);
    residual_           = VectorXd::Zero(m);
    residual_.head(n)   = weights_.cwiseProduct(r);
    const double r_norm = residual_.norm();
    closing_            = r_norm > 0. ? r_norm / z.head(n).norm() : 0.; // rest has no size
    tangents_           = jacobian;
  }

  PeriodicSolution solution() override
  {
    const PeriodicGuess start = start_of_motion();
    if (tangents_)
      if (const std::string why = why_no_mesh(member_.problem, *flow_, start); !why.empty())
        throw NoPeriodicMotion("beyond it " + why + "; use shooting");
    PeriodicSolution solution =
        collocated(member_.problem, options_.integration, *flow_, start, tangents_ && flow_->has_tangents());
    if (const double error = tangents_ ? collocation_->errors(y_).maxCoeff() : 0.; error > 10. * mesh_tolerance)
    {
      std::ostringstream note;
      note << "the mesh error of collocation would change the measures by " << error << " of their ranges";
      solution.notes.push_back(note.str());
    }
    return solution;
  }

  bool follow_motion(VectorXd &z) override;
  bool refit(const PeriodicSolution &solution, MatrixXd &Z) override;

private:
  PeriodicGuess start_of_motion() const
  {
    PeriodicGuess start;
    start.period = collocation_->period();
    collocation_->state_at_begin(y_, start.q, start.v);
    return start;
  }
  void     form(double lambda, double period);
  VectorXd packed(const VectorXd &y) const
  {
    VectorXd z(y.size() + Index(events_.size()));
    z.head(y.size()) = weights_.cwiseProduct(y);
    for (std::size_t k = 0; k < events_.size(); ++k)
      z[y.size() + Index(k)] = event_scale_ * events_[k];
    return z;
  }
  void     move_events(const std::vector<double> &events);
  void     begin_mesh(const PeriodicSolution &solution);
  void     use_mesh(const std::vector<double> &mesh, const std::vector<double> &events);
  VectorXd unknowns_of(const PeriodicSolution &solution)
  {
    const VectorXd forces = forces_along(*flow_, {solution.q, solution.v, solution.period}, mesh_);
    return collocation_->unknowns(forces, solution.q, solution.v, solution.period);
  }
  bool too_large(const std::vector<double> &mesh) const
  {
    const auto n_u = member_.problem.system->forces().directions().cols();
    // unknowns, intervals by stages by measures: a Newton step is dense and grows with their cube
    constexpr std::size_t most_of_branch = 1600;
    return mesh.size() > mesh_.size() && mesh.size() * std::size_t(PeriodicCollocation::stages * n_u) > most_of_branch;
  }
  std::vector<double> fitted(const std::vector<double> &events);

  ProblemFamily                        family_;
  PeriodicOptions                      options_;
  int                                  ratio_;
  double                               lambda_ = 0., event_scale_ = 0.;
  bool                                 tangents_ = false;
  FamilyMember                         member_;
  std::unique_ptr<PeriodFlow>          flow_;
  std::unique_ptr<PeriodicCollocation> collocation_;
  std::vector<double>                  mesh_, events_; ///< events_: those among the points of the mesh
  std::vector<Index>                   free_;
  VectorXd                             weights_, y_;
};

void CollocationBranch::form(double lambda, double period)
{
  if (collocation_ && lambda == lambda_)
    return;
  collocation_.reset();
  flow_.reset();
  member_ = member_at(family_, lambda, ratio_);
  if (member_.problem.period_is_unknown())
    member_.problem.period = period;
  flow_        = std::make_unique<PeriodFlow>(member_.problem, options_.integration);
  collocation_ = std::make_unique<PeriodicCollocation>(member_.problem, options_.integration.modes.get(),
                                                       mesh_.empty() ? nullptr : &free_, true);
  free_        = collocation_->free();
  if (!mesh_.empty())
    collocation_->set_mesh(mesh_);
  lambda_ = lambda;
}

void CollocationBranch::use_mesh(const std::vector<double> &mesh, const std::vector<double> &events)
{
  mesh_   = mesh;
  events_ = events;
  collocation_->set_mesh(mesh_);
  weights_ = collocation_->weights();
}

/// One that fits a motion, by its forces.
void CollocationBranch::begin_mesh(const PeriodicSolution &solution)
{
  const PeriodPassage      &passage = flow_->pass(solution.q, solution.v, solution.period, false);
  const std::vector<double> events  = event_points(passage.events, member_.problem.begin, solution.period);
  std::vector<double>       points  = events;
  for (std::size_t i = 1; i < least_intervals; ++i)
    points.push_back(double(i) / double(least_intervals));
  use_mesh(mesh_of(points), events);
  constexpr int rounds_of_first_mesh = 12; // a mesh that is not fitted by then is taken as it is
  for (int round = 0; round < rounds_of_first_mesh; ++round)
  {
    y_                             = unknowns_of(solution);
    event_scale_                   = small_share * weights_.cwiseProduct(y_).norm();
    const std::vector<double> next = fitted(events);
    if (equal(next, mesh_, another) || too_large(next))
      return;
    use_mesh(next, events);
  }
}

/// The mesh halved where it errs, two intervals in one where they err far too little, with points at the events.
std::vector<double> CollocationBranch::fitted(const std::vector<double> &events)
{
  const VectorXd      errors = collocation_->errors(y_);
  std::vector<double> points;
  const auto          is_event = [&](double s)
  { return std::any_of(events_.begin(), events_.end(), [&](double event) { return std::abs(event - s) <= another; }); };
  bool dropped = false;
  for (std::size_t i = 0; i + 1 < mesh_.size(); ++i)
  {
    // error of an interval, of the tolerance, by which it is joined with the next one: 2^-11
    constexpr double far_too_small = 1. / (1 << 11);
    const bool       needed =
        mesh_.size() <= least_intervals + events_.size() || dropped ||
        std::max(errors[Index(i)], errors[std::max<Index>(Index(i) - 1, 0)]) > far_too_small * mesh_tolerance;
    dropped = !needed;
    if (needed && !is_event(mesh_[i]))
      points.push_back(mesh_[i]);
    if (errors[Index(i)] > mesh_tolerance)
      points.push_back(0.5 * (mesh_[i] + mesh_[i + 1]));
  }
  points.insert(points.end(), events.begin(), events.end());
  return mesh_of(points);
}

void CollocationBranch::move_events(const std::vector<double> &events)
{
  if (events == events_)
    return;
  if (events.size() != events_.size())
    throw ConvergenceFailure("the number of events changes" + by_shooting);
  constexpr double longest_move = 0.2; // of an event, in periods: beyond it is another one
  for (std::size_t k = 0; k < events.size(); ++k)
    if (std::abs(events[k] - events_[k]) > longest_move)
      throw ConvergenceFailure("an event of the motion passes the beginning of the period" + by_shooting);
  if (!std::is_sorted(events.begin(), events.end()) || !(events.front() > 0.) || !(events.back() < 1.))
    throw ConvergenceFailure("events of the motion change their order" + by_shooting);
  mesh_   = stretched(mesh_, events_, events);
  events_ = events;
  collocation_->set_mesh(mesh_);
}

bool CollocationBranch::follow_motion(VectorXd &z)
{
  if (events_.empty())
    return false;
  const PeriodicGuess       start   = start_of_motion();
  const PeriodPassage      &passage = flow_->pass(start.q, start.v, start.period, false);
  const std::vector<double> events  = event_points(passage.events, member_.problem.begin, passage.period);
  constexpr double          located = 1e-11; // of an event, in periods
  if (events.size() != events_.size() || equal(events, events_, located))
    return false;
  move_events(events);
  z = packed(collocation_->unknowns(forces_along(*flow_, start, mesh_), start.q, start.v, start.period));
  return true;
}

bool CollocationBranch::refit(const PeriodicSolution &solution, MatrixXd &Z)
{
  const std::vector<double> events = event_points(solution.events, solution.begin, solution.period), before = mesh_,
                            next = fitted(events);
  if (equal(next, before, another) || too_large(next))
    return false;
  const MatrixXd Y = weights_.cwiseInverse().asDiagonal() * Z.topRows(weights_.size());
  use_mesh(next, events);
  if (!(event_scale_ > 0.))
    event_scale_ = small_share * Z.col(0).norm();
  const Index n = weights_.size();
  Z             = MatrixXd::Zero(n + Index(events.size()), Y.cols());
  for (Index k = 0; k < Y.cols(); ++k)
    Z.col(k).head(n) = weights_.cwiseProduct(collocation_->carried_over(before, Y.col(k)));
  Z.col(0) = packed(Z.col(0).head(n).cwiseQuotient(weights_));
  return true;
}

} // namespace

std::unique_ptr<BranchEquations> collocation_branch(const ProblemFamily &family, const PeriodicOptions &options,
                                                    int ratio)
{
  return std::make_unique<CollocationBranch>(family, options, ratio);
}

} // namespace gestell::coupling
