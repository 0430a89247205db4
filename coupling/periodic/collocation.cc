#include "coupling/periodic/collocation.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/settling.h"

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

constexpr double repeats_by_itself = 1e-10; ///< det(E - e^(Lambda T)) of a block

/// E X by blocks, for all columns.
void carry_columns(const StepTable &table, MatrixXd &X)
{
  const Index    n_p = table.E.rows();
  Eigen::ArrayXd first(n_p);
  for (Index k = 0; k < X.cols(); ++k)
  {
    auto x_1 = X.col(k).head(n_p).array(), x_2 = X.col(k).tail(n_p).array();
    first = table.E.col(0).array() * x_1 + table.E.col(1).array() * x_2;
    x_2   = table.E.col(2).array() * x_1 + table.E.col(3).array() * x_2;
    x_1   = first;
  }
}
} // namespace

PeriodicCollocation::PeriodicCollocation(const PeriodicProblem &problem)
    : problem_(problem), modes_(modal_blocks(*problem.system)), measures_(modes_, *problem.system),
      basis_(ForceBasis::gauss(stages)), n_u_(int(measures_.put.cols()))
{
  node_.resize(*problem.system);
}

void PeriodicCollocation::set_mesh(const std::vector<double> &mesh)
{
  mesh_ = mesh;
  tables_.assign(mesh.size() - 1, {});
  for (std::size_t i = 0; i + 1 < mesh.size(); ++i)
    tables_[i].fill(measures_, basis_, (mesh[i + 1] - mesh[i]) * problem_.period);
  const Index N = n_intervals(), width = Index(stages) * n_u_, n = N * width;
  MatrixXd    X = MatrixXd::Zero(2 * measures_.n_p, n + 1);
  for (std::size_t j = 0; j < modes_.harmonics.size(); ++j) // the load's own states
  {
    X(modes_.n_modal + Index(j), n)                 = std::cos(modes_.harmonics[j] * problem_.begin);
    X(measures_.n_p + modes_.n_modal + Index(j), n) = std::sin(modes_.harmonics[j] * problem_.begin);
  }
  const MatrixXd load = X;
  for (Index i = 0; i < N; ++i)
  {
    carry_columns(tables_[i], X);
    X.middleCols(i * width, width) += tables_[i].in;
    X.col(n) += tables_[i].constant;
  }
  close(X);
  start_ = load;
  for (Index b = 0; b < modes_.n_modal; ++b)
    for (const Index row : {b, measures_.n_p + b})
      start_.row(row) = X.row(row);

  G_u_.resize(n, n);
  G_v_.resize(n, n);
  u_0_.resize(n);
  v_0_.resize(n);
  X = start_;
  for (Index i = 0; i < N; ++i)
  {
    const StepTable &table = tables_[i];
    const MatrixXd   rows  = table.rows.leftCols(2 * width).transpose() * X;
    for (int j = 0; j < stages; ++j)
    {
      const Index at            = i * width + j * n_u_;
      G_u_.middleRows(at, n_u_) = rows.block(2 * j * n_u_, 0, n_u_, n);
      G_v_.middleRows(at, n_u_) = rows.block((2 * j + 1) * n_u_, 0, n_u_, n);
      u_0_.segment(at, n_u_)    = rows.block(2 * j * n_u_, n, n_u_, 1) + table.row_constant.segment(2 * j * n_u_, n_u_);
      v_0_.segment(at, n_u_) =
          rows.block((2 * j + 1) * n_u_, n, n_u_, 1) + table.row_constant.segment((2 * j + 1) * n_u_, n_u_);
    }
    G_u_.block(i * width, i * width, width, width) += table.S_u.topRows(width);
    G_v_.block(i * width, i * width, width, width) += table.S_v.topRows(width);
    carry_columns(table, X);
    X.middleCols(i * width, width) += table.in;
    X.col(n) += table.constant;
  }
}

/// x_0 = (E - e^(Lambda T))^-1 x of the modal blocks.
void PeriodicCollocation::close(MatrixXd &X) const
{
  StepTable whole;
  whole.fill(measures_, basis_, problem_.period);
  for (Index b = 0; b < modes_.n_modal; ++b)
  {
    const double a = 1. - whole.E(b, 0), c = -whole.E(b, 1), d = -whole.E(b, 2), e = 1. - whole.E(b, 3);
    const double det = a * e - c * d;
    if (!(std::abs(det) > repeats_by_itself))
      throw std::invalid_argument("collocation: a motion of the base system repeats by itself, as a rotor that nothing "
                                  "holds does; take shooting");
    const Eigen::RowVectorXd x_1 = X.row(b), x_2 = X.row(measures_.n_p + b);
    X.row(b)                 = (e * x_1 - c * x_2) / det;
    X.row(measures_.n_p + b) = (a * x_2 - d * x_1) / det;
  }
}

/// r = p(t, u, u') - P and J = E - p_u G_u - p_v G_v.
void PeriodicCollocation::evaluate(const VectorXd &P, VectorXd &r, MatrixXd *J)
{
  const LocalForces &forces = problem_.system->forces();
  const VectorXd     u = u_0_ + G_u_ * P, v = v_0_ + G_v_ * P;
  MatrixXd           p_u = MatrixXd::Zero(n_u_, n_u_), p_v = p_u;
  r.resize(P.size());
  if (J)
    *J = MatrixXd::Identity(P.size(), P.size());
  for (Index i = 0; i < n_intervals(); ++i)
    for (int j = 0; j < stages; ++j)
    {
      const Index at = (i * stages + j) * n_u_;
      node_.t        = problem_.begin + problem_.period * (mesh_[i] + basis_.points[j] * (mesh_[i + 1] - mesh_[i]));
      node_.u        = u.segment(at, n_u_);
      node_.v        = v.segment(at, n_u_);
      if (J)
      {
        forces.derivatives(node_, node_.p, p_u, p_v);
        J->middleRows(at, n_u_).noalias() -= p_u * G_u_.middleRows(at, n_u_);
        J->middleRows(at, n_u_).noalias() -= p_v * G_v_.middleRows(at, n_u_);
      }
      else
        forces.force(node_, node_.p);
      r.segment(at, n_u_) = node_.p - P.segment(at, n_u_);
    }
}

int PeriodicCollocation::solve(VectorXd &P, const PeriodicOptions &options)
{
  constexpr double rounding = 1e-13;
  problem_.system->events().follow_history(false);
  VectorXd r, next_r;
  MatrixXd J;
  for (int k = 1; k <= options.iterations; ++k)
  {
    if (problem_.interrupted())
      throw SearchInterrupted();
    evaluate(P, r, &J);
    const VectorXd dP   = lu_solution(J, r);
    double         part = 1.;
    for (; part > 1e-4; part *= 0.5)
    {
      evaluate(P + part * dP, next_r, nullptr);
      if (next_r.norm() < (1. - 0.1 * part) * r.norm() || dP.norm() <= rounding * P.norm())
        break;
    }
    P += part * dP;
    if (part * dP.norm() <= options.tolerance * P.norm() || P.isZero(0.))
      return k;
  }
  std::ostringstream text;
  text << "collocation: Newton's method does not converge in " << options.iterations
       << " iterations; begin nearer to the motion (--lead-in), or take shooting";
  throw NoPeriodicMotion(text.str());
}

VectorXd PeriodicCollocation::carried_over(const std::vector<double> &mesh, const VectorXd &P) const
{
  VectorXd other = VectorXd::Zero(n_unknowns());
  for (Index i = 0; i < n_intervals(); ++i)
    for (int j = 0; j < stages; ++j)
    {
      const double s    = mesh_[i] + basis_.points[j] * (mesh_[i + 1] - mesh_[i]);
      const auto   k    = std::clamp<Index>(std::upper_bound(mesh.begin(), mesh.end(), s) - mesh.begin() - 1, 0,
                                       Index(mesh.size()) - 2);
      const double part = (s - mesh[k]) / (mesh[k + 1] - mesh[k]);
      for (int m = 0; m < stages; ++m)
        other.segment((i * stages + j) * n_u_, n_u_) +=
            basis_.value(m, part) * P.segment((k * stages + m) * n_u_, n_u_);
    }
  return other;
}

VectorXd PeriodicCollocation::errors(const VectorXd &P)
{
  const LocalForces &forces = problem_.system->forces();
  const Index        width  = Index(stages) * n_u_;
  const VectorXd     u      = u_0_ + G_u_ * P;
  VectorXd           low = VectorXd::Constant(n_u_, 1e300), high = -low, errors = VectorXd::Zero(n_intervals());
  for (Index at = 0; at < u.size(); at += n_u_)
  {
    low  = low.cwiseMin(u.segment(at, n_u_));
    high = high.cwiseMax(u.segment(at, n_u_));
  }
  const VectorXd size = (high - low).cwiseMax(1e-300);
  VectorXd       x    = start_.leftCols(P.size()) * P + start_.col(P.size()), x_end(x.size());
  for (Index i = 0; i < n_intervals(); ++i)
  {
    const StepTable &table = tables_[i];
    const VectorXd   P_i   = P.segment(i * width, width);
    table.carry(x, x_end);
    x_end += table.constant + table.in * P_i;
    for (const bool at_end : {false, true})
    {
      node_.t = problem_.begin + problem_.period * mesh_[i + (at_end ? 1 : 0)];
      node_.u = measures_.read_u.transpose() * (at_end ? x_end : x);
      node_.v = measures_.read_v.transpose() * (at_end ? x_end : x);
      forces.force(node_, node_.p);
      VectorXd defect = node_.p;
      for (int j = 0; j < stages; ++j)
        defect -= basis_.value(j, at_end ? 1. : 0.) * P_i.segment(j * n_u_, n_u_);
      // The defect over the whole interval, as the steps of exact propagation judge theirs.
      for (int j = 0; j < stages; ++j)
        errors[i] = std::max(errors[i], 0.1 * (table.S_u.block((stages)*n_u_, j * n_u_, n_u_, n_u_) * defect)
                                                  .cwiseQuotient(size)
                                                  .cwiseAbs()
                                                  .maxCoeff());
    }
    x = x_end;
  }
  return errors;
}

void PeriodicCollocation::state_at_begin(const VectorXd &P, VectorXd &q, VectorXd &v) const
{
  const VectorXd x = start_.leftCols(P.size()) * P + start_.col(P.size());
  q                = reordered(modes_.Q, measures_.n_p) * x;
  v                = reordered(modes_.V, measures_.n_p) * x;
}

namespace
{

constexpr int    first_intervals = 16, most_unknowns = 3000, most_rounds = 12, force_samples = 1024;
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
           "the "
           "forces of the elements by the base that closes by itself.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    if (problem.period_is_unknown())
      return "collocation: the period is unknown; take shooting";
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

std::vector<PeriodicSolution> CollocationMethod::solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                                       const PeriodicOptions &options) const
{
  PeriodFlow    flow(problem, options.integration);
  PeriodicGuess near = guess;
  lead_in(flow, problem, options, near);
  const MatrixXd      samples = sampled_forces(flow, problem, near);
  std::vector<double> grid;
  for (int i = 1; i < first_intervals; ++i)
    grid.push_back(double(i) / first_intervals);
  PeriodicCollocation collocation(problem);
  std::vector<double> events = event_points(flow.passage(), problem), mesh = grid;
  mesh.insert(mesh.end(), events.begin(), events.end());
  collocation.set_mesh(sorted(mesh));
  VectorXd P          = at_gauss_points(samples, collocation.mesh()), q, v;
  double   error      = 1.;
  int      iterations = 0;
  for (int round = 0; round < most_rounds; ++round)
  {
    iterations += collocation.solve(P, options);
    collocation.state_at_begin(P, q, v);
    flow.pass(q, v, problem.period, false);
    const VectorXd errors = collocation.errors(P);
    error                 = errors.maxCoeff();
    if (error <= options.tolerance)
      break;
    // Intervals that err are halved; events lie where they are now.
    const std::vector<double> before = collocation.mesh();
    for (Index i = 0; i < errors.size(); ++i)
      if (errors[i] > options.tolerance)
        grid.push_back(0.5 * (before[std::size_t(i)] + before[std::size_t(i) + 1]));
    events = event_points(flow.passage(), problem);
    mesh   = grid;
    mesh.insert(mesh.end(), events.begin(), events.end());
    mesh = sorted(mesh);
    if (Index(mesh.size()) * PeriodicCollocation::stages * Index(samples.rows()) > most_unknowns)
      break;
    collocation.set_mesh(mesh);
    P = collocation.carried_over(before, P);
  }
  PeriodicSolution solution = told(problem, options, flow, q, v);
  solution.work.iterations  = iterations;
  std::ostringstream note;
  note << collocation.mesh().size() - 1 << " intervals; their forces err by what would move the measures by " << error
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
