#include "coupling/periodic/shooting/shooting.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/newton.h"

#include <Eigen/LU>

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

} // namespace

ShootingEquations::ShootingEquations(const PeriodicProblem &problem, const MethodOptions &integration, double omega)
    : problem_(problem), integration_(integration), flow_(problem, integration),
      omega_(omega > 0. ? omega : 2. * M_PI / problem.period)
{
}

VectorXd ShootingEquations::unknowns(const VectorXd &q, const VectorXd &v, double period) const
{
  const Index n = q.size();
  VectorXd    z(2 * n + (problem_.period_is_unknown() ? 1 : 0));
  z.head(n)       = omega_ * q;
  z.segment(n, n) = v;
  if (problem_.period_is_unknown())
    z[2 * n] = period;
  return z;
}

const PeriodPassage &ShootingEquations::pass(const VectorXd &z, bool tangents)
{
  const Index  n      = problem_.turn.size();
  const double period = problem_.period_is_unknown() ? z[2 * n] : problem_.period;
  if (!(period > 0.))
    throw ConvergenceFailure("Newton's method gives a period that is not positive");
  const PeriodPassage &passage = flow_.pass(z.head(n) / omega_, z.segment(n, n), period, tangents);
  passages_ += passage.runs;
  PeriodicWork sum{0, 0, work_};
  sum.add({0, 1, passage.work});
  work_ = sum.integration;

  const VectorXd dq = passage.q - passage.q_begin - problem_.turn, dv = passage.v - passage.v_begin;
  residual_.setZero(z.size());
  residual_.head(n)       = omega_ * dq;
  residual_.segment(n, n) = dv;
  closing_                = closing_error(dq, dv, 2. * M_PI / period, passage.fastest);
  if (problem_.period_is_unknown())
    residual_[2 * n] = z[problem_.phase] - omega_ * problem_.phase_value;
  return passage;
}

const PeriodPassage &ShootingEquations::evaluate_with(const VectorXd &z, const MatrixXd &dq, const MatrixXd &dv)
{
  flow_.carry(dq, dv);
  const PeriodPassage &passage = pass(z, true);
  flow_.carry({}, {});
  return passage;
}

VectorXd ShootingEquations::rate_at_end()
{
  VectorXd rate(2 * problem_.turn.size());
  rate << without_free(problem_, flow_.passage().v), flow_.end_acceleration();
  return rate;
}

const PeriodPassage &ShootingEquations::evaluate(const VectorXd &z, bool jacobian)
{
  const Index          n       = problem_.turn.size();
  const PeriodPassage &passage = pass(z, jacobian);
  if (!jacobian)
    return passage;
  jacobian_.setZero(z.size(), z.size());
  jacobian_.topLeftCorner(2 * n, 2 * n) = passage.monodromy - MatrixXd::Identity(2 * n, 2 * n);
  jacobian_.block(0, n, n, n) *= omega_;
  jacobian_.block(n, 0, n, n) /= omega_;
  if (!problem_.period_is_unknown())
    return passage;
  jacobian_.col(2 * n).head(2 * n) = rate_at_end();
  jacobian_.col(2 * n).head(n) *= omega_;
  jacobian_(2 * n, problem_.phase) = 1.;
  return passage;
}

PeriodicSolution ShootingEquations::solution(const std::string &method) const
{
  PeriodicSolution solution = solution_of(problem_, integration_, flow_.passage(), closing_);
  solution.method           = method;
  solution.work             = {0, passages_, work_};
  return solution;
}

namespace
{

/// Multipliers below what was left out become zero.
void note_condensed(PeriodicSolution &solution)
{
  constexpr double   told  = 10. * PassageDerivative::left_out; // what may be missing, of all motions together
  const auto         known = solution.multipliers.cwiseAbs().array() >= told;
  std::ostringstream text;
  text << "multipliers below " << told << " are given as 0: motions of which less than " << PassageDerivative::left_out
       << " remains after a period are neglected";
  solution.notes.push_back(text.str());
  solution.multipliers = known.select(solution.multipliers.array(), std::complex<double>(0.));
}

} // namespace

PeriodicSolution solution_of(const PeriodicProblem &problem, const MethodOptions &integration,
                             const PeriodPassage &passage, double closing)
{
  PeriodicSolution solution;
  solution.begin              = problem.begin;
  solution.period             = passage.period;
  solution.ratio              = problem.ratio;
  solution.q                  = passage.q_begin;
  solution.v                  = passage.v_begin;
  solution.turn               = turned(problem, passage);
  solution.residual           = closing;
  solution.events             = passage.events;
  solution.integration        = integration;
  solution.trivial_multiplier = problem.period_is_unknown();
  if (passage.monodromy.size() > 0 && passage.monodromy.rows() == passage.monodromy.cols())
    solution.multipliers = multipliers_of(passage.monodromy, problem);
  if (passage.condensed)
    note_condensed(solution);
  for (const std::string &event : passage.grazing)
    solution.notes.push_back("grazing: " + event +
                             ": the motion touches this event instead of crossing it; stability is one-sided");
  if (passage.chattering > 0.)
    solution.notes.push_back("chatter: events in " + std::to_string(100. * passage.chattering) +
                             " % of the period were not located; its derivative ignores them");
  return solution;
}

void refuse_rest(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicSolution &found)
{
  if (!problem.period_is_unknown() || !problem.turn.isZero(0.))
    return;
  const double omega = 2. * M_PI / found.period, moves = found.v.norm(),
               meant       = guess.v.norm() + omega * guess.q.norm();
  constexpr double at_rest = 1e-6; // speed of a motion, of its guess: an equilibrium, but for the steps' errors
  if (!(moves > at_rest * meant))
    throw NoPeriodicMotion(
        "the search converged to rest, which has no period; start closer to the intended solution (--lead-in)");
}

void note_residual(PeriodicSolution &solution, double tolerance)
{
  if (!(solution.residual > tolerance))
    return;
  std::ostringstream text;
  text << "the periodicity residual is " << solution.residual << " of its speed, not to " << tolerance
       << ", because of the integration error; use a smaller tolerance";
  solution.notes.push_back(text.str());
}

namespace
{

/// What moves most in the motion that Phi - E leaves free; empty: none.
std::string free_motion(const MatrixXd &jacobian, const LinearSystem &linear)
{
  const SymmetricEigenSolver squares(jacobian.transpose() * jacobian);
  constexpr double           free_to_move = 1e-11; // singular value of Phi - E, of the largest
  if (squares.eigenvalues()[0] > free_to_move * free_to_move * squares.eigenvalues().tail(1)[0])
    return "";
  const Index n = linear.size();
  Index       most;
  squares.eigenvectors().col(0).head(2 * n).cwiseAbs().maxCoeff(&most);
  return linear.coordinate_name(int(most % n));
}

[[noreturn]] void give_up(const ShootingEquations &equations, const PeriodicProblem &problem, int iterations)
{
  std::ostringstream text;
  text << "shooting does not converge: after " << iterations << " Newton steps it still misses the initial state by "
       << equations.closing() << " of its speed";
  if (const auto &held = problem.system->forces().held(); !held.empty())
    text << "; " << problem.system->forces().element_of(held.front().measure)
         << " sticks at the end of the period: if it sticks throughout, the solution is not isolated (any nearby "
            "position also works)";
  else if (equations.jacobian().size() > 0)
    if (const std::string free = free_motion(equations.jacobian(), problem.system->linear()); !free.empty())
      throw UndeterminedMotion(text.str() + "; undetermined DOF " + free + ": add a spring, or give it a drive");
  text << "; start closer to it (more periods of lead-in), or try --method settling or minimise";
  throw NoPeriodicMotion(text.str());
}

} // namespace

PeriodicSolution shoot(ShootingEquations &equations, const PeriodicProblem &problem, VectorXd z,
                       const PeriodicOptions &options)
{
  const bool with_motion = equations.flow().has_tangents(); // else its matrix costs more than a passage, and is kept
  double     before = 0., after = 0.;
  const auto length = [&](const VectorXd &next)
  {
    equations.evaluate(next, with_motion);
    return after = equations.residual().norm();
  };
  const auto step = [&](NewtonResult &newton) -> NewtonStep
  {
    if (equations.closing() <= options.tolerance || problem.interrupted())
      return {};
    constexpr double good = 0.3; // residual after a step, of that before, with which its matrix is kept
    if (!with_motion && !(newton.iterations > 0 && after < good * before))
      equations.evaluate(z, true);
    const VectorXd dz = -equations.jacobian().partialPivLu().solve(equations.residual());
    if (!dz.allFinite())
      give_up(equations, problem, newton.iterations);
    before = equations.residual().norm();
    return {dz, before};
  };
  length(z);
  const int        iterations    = solve_by_newton(z, options.iterations, step, length).iterations;
  constexpr double as_integrated = 1e-7; // closing error that rounding and the steps' tolerance may leave at worst
  if (!(equations.closing() <= std::max(options.tolerance, as_integrated)))
    give_up(equations, problem, iterations);
  if (!with_motion)
  {
    equations.flow().begin_anew();
    equations.evaluate(z, true); // for all multipliers
  }
  PeriodicSolution solution = equations.solution("shooting");
  solution.work.iterations  = iterations;
  note_residual(solution, options.tolerance);
  return solution;
}

} // namespace gestell::coupling
