#include "coupling/periodic/collocation/mesh_search.h"

#include "coupling/periodic/shooting/shooting.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

} // namespace

VectorXd forces_along(PeriodFlow &flow, const PeriodicGuess &start, const std::vector<double> &mesh)
{
  const ForceBasis    basis = ForceBasis::gauss(PeriodicCollocation::stages);
  std::vector<double> points;
  for (std::size_t i = 0; i + 1 < mesh.size(); ++i)
    for (int j = 0; j < PeriodicCollocation::stages; ++j)
      points.push_back(mesh[i] + basis.points[std::size_t(j)] * (mesh[i + 1] - mesh[i]));
  std::vector<VectorXd> forces;
  flow.look_at(points, [&](const OrbitPoint &point) { forces.push_back(point.local.p); });
  flow.pass(start.q, start.v, start.period, false);
  flow.look_at({}, {});
  const Index n_u = forces.front().size();
  VectorXd    P(Index(forces.size()) * n_u);
  for (std::size_t k = 0; k < forces.size(); ++k)
    P.segment(Index(k) * n_u, n_u) = forces[k];
  return P;
}

std::vector<double> mesh_of(std::vector<double> mesh)
{
  std::sort(mesh.begin(), mesh.end());
  std::vector<double> kept       = {0.};
  constexpr double    same_point = 1e-9; // of the period: rounding of events
  for (const double s : mesh)
    if (s > kept.back() + same_point && s < 1. - same_point)
      kept.push_back(s);
  kept.push_back(1.);
  return kept;
}

std::vector<double> event_points(const std::vector<Event> &events, double begin, double period)
{
  std::vector<double> points;
  for (const Event &event : events)
    points.push_back((event.t - begin) / period);
  return points;
}

MeshSearch::MeshSearch(const PeriodicProblem &problem, const PeriodicOptions &options)
    : problem_(problem), options_(options), flow_(problem, options.integration),
      collocation_(problem, options.integration.modes.get())
{
}

void MeshSearch::set_mesh(std::vector<double> points)
{
  const std::vector<double> events = event_points(flow_.passage().events, problem_.begin, flow_.passage().period);
  points.insert(points.end(), events.begin(), events.end());
  collocation_.set_mesh(mesh_of(points));
}

std::string why_no_mesh(const PeriodicProblem &problem, PeriodFlow &flow, const PeriodicGuess &start)
{
  const LocalForces      &forces = problem.system->forces();
  std::vector<LocalState> states;
  int                     held           = -1;
  constexpr int           memory_samples = 256; // of a period: forces that remember differ somewhere for a 256th of it
  flow.look_on(memory_samples,
               [&](const OrbitPoint &point)
               {
                 states.push_back(point.local);
                 if (!forces.held().empty())
                   held = forces.held().front().measure;
               });
  flow.pass(start.q, start.v, start.period, false);
  flow.look_on(0, {});
  if (held >= 0)
    return forces.element_of(held) + " sticks, and its sticking force has no force law";
  problem.system->events().follow_history(false);
  VectorXd p = VectorXd::Zero(states.front().p.size()), largest = p, differs = p;
  for (LocalState &state : states)
  {
    const VectorXd passed = state.p;
    forces.force(state, p);
    largest = largest.cwiseMax(passed.cwiseAbs());
    differs = differs.cwiseMax((p - passed).cwiseAbs());
  }
  for (const ForceBlock &block : forces.blocks())
  {
    const double size  = largest.segment(block.first_measure, block.n_measures).maxCoeff();
    const double error = differs.segment(block.first_measure, block.n_measures).maxCoeff();
    // share of the largest force above which memory counts; a branch kept up to its event is less
    constexpr double remembered = 1e-3;
    if (!(error > remembered * size))
      continue;
    std::ostringstream text;
    text.precision(2);
    text << forces.element_of(block.first_measure) << " has hysteresis, by " << error / size
         << " of its largest force: its force depends on the past";
    return text.str();
  }
  return "";
}

void MeshSearch::refuse_memory(const PeriodicGuess &start)
{
  if (const std::string why = why_no_mesh(problem_, flow_, start); !why.empty())
    throw std::invalid_argument("collocation: " + why + "; use shooting");
}

void MeshSearch::begin(const PeriodicGuess &guess)
{
  PeriodicGuess start = guess;
  if (!problem_.period_is_unknown() || !(start.period > 0.))
    start.period = problem_.period;
  refuse_memory(start);
  // at first, doubled while Newton's method does not converge
  constexpr int first_intervals = 16, most_at_first = 128;
  for (int n = first_intervals;; n *= 2)
    try
    {
      grid_.clear();
      for (int i = 1; i < n; ++i)
        grid_.push_back(double(i) / n);
      set_mesh(grid_);
      P_ = collocation_.unknowns(forces_along(flow_, start, collocation_.mesh()), start.q, start.v, start.period);
      solve();
      return;
    }
    catch (const SearchInterrupted &)
    {
      throw;
    }
    catch (const NoPeriodicMotion &)
    {
      if (n >= most_at_first)
        throw;
    }
}

void MeshSearch::solve()
{
  iterations_ += collocation_.solve(P_, options_);
  collocation_.state_at_begin(P_, q_, v_);
  errors_ = collocation_.errors(P_);
}

bool MeshSearch::refine()
{
  const std::vector<double> before = collocation_.mesh();
  for (Index i = 0; i < errors_.size(); ++i)
    if (errors_[i] > options_.tolerance)
      grid_.push_back(0.5 * (before[std::size_t(i)] + before[std::size_t(i) + 1]));
  flow_.pass(q_, v_, collocation_.period(), false);
  const Index   width         = PeriodicCollocation::stages * problem_.system->forces().directions().cols();
  constexpr int most_unknowns = 3000; // dense: 27e9/3 multiplications a Newton step
  if (Index(grid_.size() + flow_.passage().events.size()) * width > most_unknowns)
    return false;
  set_mesh(grid_);
  P_ = collocation_.carried_over(before, P_);
  return true;
}

void MeshSearch::run(const PeriodicGuess &guess)
{
  begin(guess);
  constexpr int most_rounds = 24; // each halves what errs most
  for (int round = 1; round < most_rounds && error() > options_.tolerance && refine(); ++round)
    solve();
  PeriodicSolution found;
  found.period = collocation_.period();
  found.q      = q_;
  found.v      = v_;
  refuse_rest(problem_, guess, found);
  constexpr double far_off = 1e-3; // error of a mesh that is no answer
  if (!(error() <= far_off))
  {
    std::ostringstream text;
    text << "collocation: on the finest mesh the error of the forces would still change the measures by " << error()
         << " of their ranges; use shooting";
    throw NoPeriodicMotion(text.str());
  }
  refuse_memory({q_, v_, collocation_.period()});
}

PeriodicSolution MeshSearch::solution()
{
  PeriodicSolution solution =
      collocated(problem_, options_.integration, flow_, {q_, v_, collocation_.period()}, flow_.has_tangents());
  solution.work.iterations = iterations_;
  std::ostringstream note;
  note << errors_.size() << " intervals; the error of the forces would change the measures by " << error()
       << " of their ranges" << (error() > options_.tolerance ? ", not the " : "");
  if (error() > options_.tolerance)
    note << options_.tolerance << " requested: the mesh has reached its finest level";
  solution.notes.push_back(note.str());
  return solution;
}

PeriodicSolution collocated(const PeriodicProblem &problem, const MethodOptions &integration, PeriodFlow &flow,
                            const PeriodicGuess &start, bool tangents)
{
  const PeriodPassage &passage = flow.pass(start.q, start.v, start.period, tangents);
  const double         closing =
      closing_error(passage.q - start.q - problem.turn, passage.v - start.v, 2. * M_PI / start.period, passage.fastest);
  PeriodicSolution solution = solution_of(problem, integration, passage, closing);
  solution.method           = "collocation";
  return solution;
}

} // namespace gestell::coupling
