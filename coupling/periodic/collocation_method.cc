#include "coupling/periodic/collocation_method.h"

#include "coupling/periodic/collocation.h"
#include "coupling/periodic/settling.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int first_intervals = 16, most_at_first = 128, most_unknowns = 3000, most_rounds = 24, force_samples = 1024;
constexpr double same_point = 1e-9; ///< of the period

/// Forces along the motion that starts at the guess, at `force_samples` + 1 instants [n_u x ...].
MatrixXd sampled_forces(PeriodFlow &flow, const PeriodicProblem &problem, const PeriodicGuess &guess)
{
  MatrixXd samples(problem.system->forces().directions().cols(), force_samples + 1);
  Index    k = 0;
  flow.look_on(force_samples, [&](const OrbitPoint &point) { samples.col(k++) = point.local.p; });
  flow.pass(guess.q, guess.v, problem.period, false);
  flow.look_on(0, {});
  return samples;
}

/// The same at the Gauss points of a mesh, linear between samples.
VectorXd at_gauss_points(const MatrixXd &samples, const std::vector<double> &mesh)
{
  const ForceBasis basis = ForceBasis::gauss(PeriodicCollocation::stages);
  const Index      n_u   = samples.rows();
  VectorXd         P(Index(mesh.size() - 1) * PeriodicCollocation::stages * n_u);
  Index            at = 0;
  for (std::size_t i = 0; i + 1 < mesh.size(); ++i)
    for (int j = 0; j < PeriodicCollocation::stages; ++j, at += n_u)
    {
      const double x     = force_samples * (mesh[i] + basis.points[j] * (mesh[i + 1] - mesh[i]));
      const Index  k     = std::min<Index>(Index(x), force_samples - 1);
      P.segment(at, n_u) = samples.col(k) + (x - double(k)) * (samples.col(k + 1) - samples.col(k));
    }
  return P;
}

/// Ascending, each once; what lies nearer than `same_point` is one.
std::vector<double> sorted(std::vector<double> mesh)
{
  std::sort(mesh.begin(), mesh.end());
  std::vector<double> kept = {0.};
  for (const double s : mesh)
    if (s > kept.back() + same_point && s < 1. - same_point)
      kept.push_back(s);
  kept.push_back(1.);
  return kept;
}

std::vector<double> event_points(const PeriodPassage &passage, const PeriodicProblem &problem)
{
  std::vector<double> points;
  for (const Event &event : passage.events)
    points.push_back((event.t - problem.begin) / problem.period);
  return points;
}

class CollocationMethod final : public PeriodicMethod
{
public:
  std::string name() const override { return "collocation"; }
  std::string meaning() const override
  {
    return "Orthogonal collocation on a mesh that is divided where it errs, with points at the events; condensed to "
           "the forces of the elements by the base that closes by itself.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    if (problem.period_is_unknown())
      return "the period is unknown; take shooting";
    return why_not_propagated(*problem.system, "settling");
  }
  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;

private:
  static PeriodicSolution told(const PeriodicProblem &problem, const PeriodicOptions &options, PeriodFlow &flow,
                               const VectorXd &q, const VectorXd &v);
};

PeriodicSolution CollocationMethod::told(const PeriodicProblem &problem, const PeriodicOptions &options,
                                         PeriodFlow &flow, const VectorXd &q, const VectorXd &v)
{
  const PeriodPassage &passage = flow.pass(q, v, problem.period, flow.has_tangents());
  PeriodicSolution     solution;
  solution.begin  = problem.begin;
  solution.period = problem.period;
  solution.ratio  = problem.ratio;
  solution.q      = q;
  solution.v      = v;
  solution.turn   = problem.turn;
  solution.residual =
      closing_error(passage.q - q - problem.turn, passage.v - v, 2. * M_PI / problem.period, passage.fastest);
  solution.events      = passage.events;
  solution.method      = "collocation";
  solution.integration = options.integration;
  if (flow.has_tangents())
    solution.multipliers = multipliers_of(passage.monodromy);
  return solution;
}

/// A search on meshes that are divided where they err.
class MeshSearch
{
public:
  MeshSearch(const PeriodicProblem &problem, const PeriodicOptions &options)
      : problem_(problem), options_(options), flow_(problem, options.integration), collocation_(problem)
  {
  }

  PeriodFlow &flow() { return flow_; }
  /// On uniform meshes, finer where Newton's method does not converge from the guess.
  void begin(const PeriodicGuess &guess);
  /// Halves intervals that err, with points at the events of the motion as it is now; false: no more can be done.
  bool refine();
  void solve();

  const VectorXd &q() const { return q_; }
  const VectorXd &v() const { return v_; }
  double          error() const { return errors_.maxCoeff(); } ///< see PeriodicCollocation::errors()
  int             iterations() const { return iterations_; }
  int             intervals() const { return int(collocation_.mesh().size()) - 1; }

private:
  void set_mesh(std::vector<double> points);

  const PeriodicProblem &problem_;
  const PeriodicOptions &options_;
  PeriodFlow             flow_;
  PeriodicCollocation    collocation_;
  std::vector<double>    grid_; ///< points but for those of events
  VectorXd               P_, q_, v_, errors_;
  int                    iterations_ = 0;
};

void MeshSearch::set_mesh(std::vector<double> points)
{
  const std::vector<double> events = event_points(flow_.passage(), problem_);
  points.insert(points.end(), events.begin(), events.end());
  collocation_.set_mesh(sorted(points));
}

void MeshSearch::begin(const PeriodicGuess &guess)
{
  const MatrixXd samples = sampled_forces(flow_, problem_, guess);
  for (int n = first_intervals;; n *= 2)
    try
    {
      grid_.clear();
      for (int i = 1; i < n; ++i)
        grid_.push_back(double(i) / n);
      set_mesh(grid_);
      P_ = collocation_.unknowns(at_gauss_points(samples, collocation_.mesh()), guess.q, guess.v);
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
  flow_.pass(q_, v_, problem_.period, false);
  const Index width = PeriodicCollocation::stages * problem_.system->forces().directions().cols();
  if (Index(grid_.size() + flow_.passage().events.size()) * width > most_unknowns)
    return false;
  set_mesh(grid_);
  P_ = collocation_.carried_over(before, P_);
  return true;
}

std::vector<PeriodicSolution> CollocationMethod::solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                                       const PeriodicOptions &options) const
{
  MeshSearch    search(problem, options);
  PeriodicGuess near = guess;
  lead_in(search.flow(), problem, options, near);
  search.begin(near);
  for (int round = 1; round < most_rounds && search.error() > options.tolerance && search.refine(); ++round)
    search.solve();
  PeriodicSolution solution = told(problem, options, search.flow(), search.q(), search.v());
  solution.work.iterations  = search.iterations();
  std::ostringstream note;
  note << search.intervals() << " intervals; their forces err by what would move the measures by " << search.error()
       << " of their excursions";
  solution.notes.push_back(note.str());
  return {solution};
}

} // namespace

const PeriodicMethod &collocation_method()
{
  static const CollocationMethod method;
  return method;
}

} // namespace gestell::coupling
