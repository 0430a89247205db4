#include "coupling/periodic/harmonic_balance_method.h"

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/hill.h"
#include "coupling/periodic/period_flow.h"

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shortest_share  = 1. / 256.; ///< of a Newton step
constexpr double floor_of_steps  = 1e-13;     ///< a Newton step that is rounding, relative
constexpr double remembered      = 1e-9;      ///< share of the force above which memory counts
constexpr int    first_harmonics = 8, most_harmonics = 128, most_unknowns = 2500;

double largest_share(const VectorXd &r, const VectorXd &scale)
{
  return r.size() > 0 ? r.cwiseQuotient(scale).cwiseAbs().maxCoeff() : 0.;
}

/// Takes the share of the step that lowers the residual; false: none does.
bool search_line(HarmonicBalance &balance, const VectorXd &step, const VectorXd &scale, bool period_unknown,
                 VectorXd &z, double norm)
{
  VectorXd r;
  for (double share = 1.; share >= shortest_share; share *= 0.5)
  {
    const VectorXd next = z + share * step;
    if (period_unknown &&
        !(next[next.size() - 1] > 0.5 * z[z.size() - 1] && next[next.size() - 1] < 2. * z[z.size() - 1]))
      continue;
    balance.residual(next, r);
    if (r.allFinite() && r.cwiseQuotient(scale).norm() <= (1. - 1e-4 * share) * norm)
    {
      z = next;
      return true;
    }
  }
  return false;
}

std::string count_of(int n, const std::string &noun)
{
  return std::to_string(n) + " " + noun;
}

} // namespace

HarmonicNewton solve_balance(HarmonicBalance &balance, const PeriodicOptions &options, VectorXd &z)
{
  HarmonicNewton newton;
  VectorXd       r;
  MatrixXd       J;
  bool           polished = false;
  for (; newton.iterations < options.iterations && !balance.interrupted(); ++newton.iterations)
  {
    balance.linearise(z, r, J);
    const VectorXd scale = balance.scales(z);
    newton.residual      = largest_share(r, scale);
    newton.converged     = newton.residual <= options.tolerance;
    if (!r.allFinite() || polished)
      break;
    polished            = newton.converged; // a last step of quadratic convergence
    const VectorXd step = -lu_solution(J, r);
    if (!step.allFinite())
      break;
    const bool rounding = largest_share(step, scale) <= floor_of_steps;
    if (rounding || !search_line(balance, step, scale, balance.period_is_unknown(), z, r.cwiseQuotient(scale).norm()))
    {
      newton.converged = newton.converged || rounding;
      break;
    }
  }
  return newton;
}

PeriodicSolution balanced_solution(const PeriodicProblem &problem, HarmonicBalance &balance, const VectorXd &z,
                                   const HarmonicNewton &newton)
{
  PeriodicSolution solution;
  balance.state_at_begin(z, solution.q, solution.v);
  solution.begin              = problem.begin;
  solution.period             = balance.period();
  solution.ratio              = problem.ratio;
  solution.turn               = problem.turn;
  solution.residual           = newton.residual;
  solution.series             = balance.series(z);
  solution.method             = "harmonic-balance";
  solution.work.iterations    = newton.iterations;
  solution.trivial_multiplier = problem.period_is_unknown();
  return solution;
}

namespace
{

/// Of the motion that starts where the series does.
void multipliers_by_a_period(const PeriodicProblem &problem, PeriodicSolution &solution)
{
  PeriodFlow flow(problem, solution.integration);
  if (flow.has_tangents())
    solution.multipliers = multipliers_of(flow.pass(solution.q, solution.v, solution.period, true).monodromy);
}

/// None where forces depend on accelerations.
void find_multipliers(const PeriodicProblem &problem, HarmonicBalance &balance, const VectorXd &z,
                      PeriodicSolution &solution)
{
  if (floquet_way(problem, balance.harmonics()) == FloquetWay::shooting)
  {
    multipliers_by_a_period(problem, solution);
    return;
  }
  VectorXd r;
  MatrixXd J;
  balance.linearise(z, r, J);
  for (const HarmonicForces::Derivative &d : balance.derivatives())
    if (d.of_a.size() > 0)
      return;
  solution.multipliers =
      hill_multipliers(problem, 2. * M_PI / balance.period(), balance.harmonics(), balance.derivatives()).multipliers;
}

} // namespace

PeriodicSolution finished_balance(const PeriodicProblem &problem, HarmonicBalance &balance, const VectorXd &z,
                                  const HarmonicNewton &newton, const PeriodicOptions &options)
{
  PeriodicSolution solution = balanced_solution(problem, balance, z, newton);
  solution.integration      = options.integration;
  find_multipliers(problem, balance, z, solution);
  return solution;
}

namespace
{

class HarmonicBalanceMethod final : public PeriodicMethod
{
public:
  std::string name() const override { return "harmonic-balance"; }
  std::string meaning() const override
  {
    return "Fourier series (Ritz-Galerkin, 5.5.4), condensed to the measures by the dynamic stiffness of the modes; "
           "forces by alternating between frequency and time (Cameron and Griffin 1989)";
  }
  std::string refuses(const PeriodicProblem &problem) const override;

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;

private:
  static HarmonicNewton first_solution(HarmonicBalance &balance, const PeriodicGuess &guess,
                                       const PeriodicOptions &options, VectorXd &z);
  static int            next_harmonics(const HarmonicBalance &balance, int n_measures);
};

std::string HarmonicBalanceMethod::refuses(const PeriodicProblem &problem) const
{
  const SecondOrderSystem &system = *problem.system;
  if (const int n = system.joints().n_rows(); n > 0)
    return "harmonic balance: " + count_of(n, "equations of ideal joints, the first of ") + system.joints().name(0) +
           ", are not balanced by it; take shooting, or compliant joints";
  if (system.linear().excitation().has_rest())
    return "harmonic balance: the load is no sum of harmonics; take shooting";
  MatrixXd M, B, C;
  if (!system.linear().dense_matrices(M, B, C))
    return "harmonic balance: it works in the modes of the base system, and an unreduced frame has too many; reduce "
           "the frame, or take shooting";
  if (problem.period_is_unknown() && !system.linear().excitation().is_constant())
    return "harmonic balance: the load gives the period, and a phase condition asks for another; leave one of them out";
  return "";
}

HarmonicNewton HarmonicBalanceMethod::first_solution(HarmonicBalance &balance, const PeriodicGuess &guess,
                                                     const PeriodicOptions &options, VectorXd &z)
{
  const bool moves =
      guess.q.size() > 0 && guess.v.size() == guess.q.size() && !(guess.q.isZero(0.) && guess.v.isZero(0.));
  z                     = moves ? balance.start_through(guess.q, guess.v) : balance.linear_start();
  HarmonicNewton newton = solve_balance(balance, options, z);
  if (newton.converged || !moves)
    return newton;
  const int before = newton.iterations;
  z                = balance.linear_start();
  newton           = solve_balance(balance, options, z);
  newton.iterations += before;
  return newton;
}

/// 0: there are enough.
int HarmonicBalanceMethod::next_harmonics(const HarmonicBalance &balance, int n_measures)
{
  const int next = 2 * balance.harmonics();
  return next > most_harmonics || n_measures * (2 * next + 1) > most_unknowns ? 0 : next;
}

std::vector<PeriodicSolution> HarmonicBalanceMethod::solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                                           const PeriodicOptions &options) const
{
  if (const std::string reason = refuses(problem); !reason.empty())
    throw std::invalid_argument(reason);
  PeriodicProblem own = problem;
  if (problem.period_is_unknown() && guess.period > 0.)
    own.period = guess.period;
  const int       n_u = int(own.system->forces().directions().cols());
  HarmonicBalance balance(own, options.harmonics > 0 ? options.harmonics : first_harmonics);
  if (options.harmonics == 0 && balance.largest_load() > first_harmonics)
    balance.set_harmonics(balance.largest_load());
  VectorXd       z;
  HarmonicNewton newton     = first_solution(balance, guess, options, z);
  int            iterations = newton.iterations;
  double         left_out   = newton.converged ? balance.left_out(z) : 0.;
  while (newton.converged && options.harmonics == 0 && left_out > options.tolerance && !problem.interrupted())
  {
    const int next = next_harmonics(balance, n_u);
    if (next == 0)
      break;
    const FourierSeries motion = balance.series(z);
    balance.set_harmonics(next);
    z      = balance.pack(motion);
    newton = solve_balance(balance, options, z);
    iterations += newton.iterations;
    left_out = balance.left_out(z);
  }
  std::ostringstream note;
  note.precision(2);
  if (!newton.converged)
  {
    note << "harmonic balance: Newton's method with " << balance.harmonics() << " harmonics has come to a residual of "
         << newton.residual << " of the motion after " << iterations << " iterations; begin nearer to the motion, or "
         << "take settling";
    throw ConvergenceFailure(note.str());
  }
  if (const double memory = balance.memory(z); memory > remembered)
  {
    note << "harmonic balance: an element remembers the periods before, by " << memory
         << " of its force, which a law of the motion alone does not; take shooting";
    throw std::invalid_argument(note.str());
  }
  PeriodicSolution solution = balanced_solution(own, balance, z, newton);
  solution.work.iterations  = iterations;
  note << balance.harmonics() << " harmonics of " << balance.samples() << " samples; forces of higher ones would add "
       << left_out << " of the motion";
  if (left_out > options.tolerance)
    note << (options.harmonics > 0 ? ", ask for more harmonics" : ", as kinks of a law do; shooting is exact there");
  solution.notes.push_back(note.str());
  solution.integration = options.integration;
  find_multipliers(own, balance, z, solution);
  return {solution};
}

} // namespace

const PeriodicMethod &harmonic_balance_method()
{
  static const HarmonicBalanceMethod method;
  return method;
}

} // namespace gestell::coupling
