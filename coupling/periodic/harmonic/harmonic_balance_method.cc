#include "coupling/periodic/harmonic/harmonic_balance_method.h"

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/harmonic/hill.h"
#include "coupling/periodic/harmonic/orbit_series.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shift_invariance.h"
#include "coupling/periodic/shooting/shooting_method.h"

#include <cmath>
#include <sstream>
#include <tuple>

namespace gestell::coupling
{

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest_share(const VectorXd &r, const VectorXd &scale)
{
  return r.size() > 0 ? r.cwiseQuotient(scale).cwiseAbs().maxCoeff() : 0.;
}
} // namespace

int harmonics_of(const PeriodicOptions &options)
{
  return int(options.value("harmonics", 0.));
}

PeriodicOptions with_harmonics(PeriodicOptions options, int harmonics)
{
  options.own["harmonics"] = harmonics;
  return options;
}

NewtonResult solve_balance(HarmonicBalance &balance, const PeriodicOptions &options, VectorXd &z)
{
  VectorXd   r, scale;
  MatrixXd   J;
  const auto step = [&](NewtonResult &newton) -> NewtonStep
  {
    if (balance.interrupted())
      return {};
    const bool polished = newton.converged; // by a last step of quadratic convergence
    balance.linearise(z, r, J);
    scale            = balance.scales_of_rounding(z);
    newton.residual  = largest_share(r, scale);
    newton.converged = newton.residual <= options.tolerance;
    if (!r.allFinite() || polished)
      return {};
    const VectorXd   dz             = -lu_solution(J, r);
    constexpr double floor_of_steps = 1e-13; // a Newton step that is rounding, relative
    if (dz.allFinite() && largest_share(dz, scale) <= floor_of_steps)
    {
      newton.converged = true;
      return {};
    }
    return {dz, r.cwiseQuotient(scale).norm(), 1e-4, 1., 1. / 512};
  };
  const auto length = [&](const VectorXd &next)
  {
    if (const auto T = z.size() - 1; balance.period_is_unknown() && !(next[T] > 0.5 * z[T] && next[T] < 2. * z[T]))
      return std::numeric_limits<double>::infinity();
    balance.residual(next, r);
    return r.cwiseQuotient(scale).norm();
  };
  return solve_by_newton(z, options.iterations, step, length);
}

namespace
{
/// Of the motion that starts where the series does; where that does not close, of the one near it that does.
void multipliers_by_a_period(const PeriodicProblem &problem, PeriodicSolution &solution)
{
  PeriodFlow flow(problem, solution.integration);
  if (!flow.has_tangents())
    return;
  const PeriodPassage &passage = flow.pass(solution.q, solution.v, solution.period, true);
  const double         closing = closing_error(passage.q - solution.q - problem.turn, passage.v - solution.v,
                                               2. * M_PI / solution.period, passage.fastest);
  solution.multipliers         = multipliers_of(passage.monodromy, problem);
  constexpr double closes_well = 1e-5; // of a period whose multipliers are those of the motion
  if (closing <= closes_well)
    return;
  PeriodicOptions near = without_lead_in({});
  near.integration     = solution.integration;
  try
  {
    const PeriodicSolution closed =
        shooting_method().solve(problem, {solution.q, solution.v, solution.period}, near).front();
    const double     omega   = 2. * M_PI / solution.period;
    constexpr double near_by = 0.1; // distance of two motions that are one, of their size
    if (std::hypot(omega * (closed.q - solution.q).norm(), (closed.v - solution.v).norm()) <=
        near_by * std::hypot(omega * solution.q.norm(), solution.v.norm()))
    {
      solution.multipliers = closed.multipliers;
      return;
    }
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const std::exception &) // no motion that closes near by
  {
  }
  std::ostringstream note;
  note.precision(2);
  note << "its stability is unknown: integrated over a period, it misses the initial state by " << closing
       << " of its speed";
  solution.multipliers.resize(0);
  solution.notes.push_back(note.str());
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
  const HillMultipliers hill =
      hill_multipliers(problem, 2. * M_PI / balance.period(), balance.harmonics(), balance.derivatives());
  solution.multipliers = hill.multipliers;
  // The shift in time shows what the truncation leaves; far too few harmonics make a stable motion unstable.
  const double     shift     = solution.trivial_multiplier ? (hill.multipliers.array() - 1.).abs().minCoeff() : 0.;
  constexpr double poor_hill = 1e-3; // error of Hill's multipliers above which a period is integrated
  if (std::max(hill.left_out, shift) > poor_hill)
    multipliers_by_a_period(problem, solution);
}
} // namespace

PeriodicSolution finished_balance(const PeriodicProblem &problem, HarmonicBalance &balance, const VectorXd &z,
                                  double residual, const PeriodicOptions &options)
{
  PeriodicSolution solution;
  balance.state_at_begin(z, solution.q, solution.v);
  solution.begin              = problem.begin;
  solution.period             = balance.period();
  solution.ratio              = problem.ratio;
  solution.turn               = problem.turn;
  solution.residual           = residual;
  solution.series             = balance.series(z);
  solution.method             = "harmonic-balance";
  solution.trivial_multiplier = problem.period_is_unknown();
  solution.integration        = options.integration;
  find_multipliers(problem, balance, z, solution);
  return solution;
}

int more_harmonics(const PeriodicProblem &problem, int harmonics)
{
  const int     next = 2 * harmonics, n_u = int(problem.system->forces().directions().cols());
  constexpr int most_harmonics = 128;  // kinks leave 1 / 128^2 of their force; more are for collocation
  constexpr int most_unknowns  = 2500; // dense: 16e9/3 multiplications a Newton step
  return next > most_harmonics || n_u * (2 * next + 1) > most_unknowns ? 0 : next;
}

std::string note_of_harmonics(const HarmonicBalance &balance, const HarmonicBalance::LeftOut &left, double tolerance,
                              bool given)
{
  std::ostringstream note;
  note.precision(2);
  note << balance.harmonics() << " harmonics of " << balance.samples() << " samples; the omitted harmonics would add "
       << left.motion << " of the motion and change the forces by " << left.forces << " of their range";
  if (left.motion > tolerance)
    note << (given ? "; request more harmonics" : ", as kinks of a force law do; shooting is exact there");
  return note.str();
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

  std::vector<PeriodicOption> options() const override
  {
    return {{"harmonics", "of harmonic balance (default: until the truncation error is small)", 1., 1e4},
            lead_in_option()};
  }
  bool integrates() const override { return false; }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;
};

std::string HarmonicBalanceMethod::refuses(const PeriodicProblem &problem) const
{
  const SecondOrderSystem &system = *problem.system;
  if (const int n = system.joints().n_rows(); n > 0)
    return "harmonic balance: " + std::to_string(n) + " equations of ideal joints, the first of " +
           system.joints().name(0) + ", are not supported; use shooting, or compliant joints";
  if (system.linear().excitation().has_rest())
    return "harmonic balance: the load is not a sum of harmonics; use shooting";
  MatrixXd M, B, C;
  if (!system.linear().dense_matrices(M, B, C))
    return "harmonic balance: it works in the modes of the base system, and an unreduced frame has too many; reduce "
           "the frame, or use shooting";
  if (problem.has_free_shifts())
    return "harmonic balance: no force depends on the angle of " + free_coordinate(problem) +
           ", so its rotation in a period is arbitrary, but a series needs that angle beforehand; use shooting";
  if (problem.period_is_unknown() && !system.linear().excitation().is_constant())
    return "harmonic balance: the load determines the period, so a phase condition is not possible; remove one of them";
  return "";
}

/// From starts that cost more and more to a solution, and from few harmonics to enough.
class BalanceSearch
{
public:
  BalanceSearch(const PeriodicProblem &problem, const PeriodicOptions &options)
      : problem_(problem), options_(options),
        balance_(problem, harmonics_of(options) > 0 ? harmonics_of(options) : first_harmonics)
  {
    if (harmonics_of(options) == 0 && balance_.largest_load() > first_harmonics)
      balance_.set_harmonics(balance_.largest_load());
    balance_.require_load();
  }

  void             begin(const PeriodicGuess &guess);
  void             grow();
  void             sample_finely();
  PeriodicSolution solution();

private:
  bool solve_from(const VectorXd &start);
  bool solve_from_orbit(PeriodicGuess guess, bool leads);
  void check_memory();

  static constexpr int first_harmonics = 8; ///< laws that are nearly linear need no more

  const PeriodicProblem   &problem_;
  const PeriodicOptions   &options_;
  HarmonicBalance          balance_;
  VectorXd                 z_;
  NewtonResult             newton_;
  int                      iterations_ = 0;
  PeriodicGuess            guess_;
  HarmonicBalance::LeftOut left_out_;
  std::string              failed_; ///< numbers of harmonics without a solution
  std::string              others_; ///< that these are not of the motion found with fewer
};

bool BalanceSearch::solve_from(const VectorXd &start)
{
  z_      = start;
  newton_ = solve_balance(balance_, options_, z_);
  iterations_ += newton_.iterations;
  return newton_.converged;
}

/// From the motion that is integrated from the guess, or from the end of its lead-in; false too if that fails.
bool BalanceSearch::solve_from_orbit(PeriodicGuess guess, bool leads)
{
  const auto n = problem_.system->linear().size();
  if (guess.q.size() != n || guess.v.size() != n)
    guess.q = guess.v = VectorXd::Zero(n);
  if (!(guess.period > 0.))
    guess.period = problem_.period;
  try
  {
    PeriodFlow flow(problem_, options_.integration);
    if (leads)
      lead_in(flow, problem_, options_, guess);
    return solve_from(
        balance_.pack(orbit_series(problem_, flow, guess.q, guess.v, guess.period, balance_.harmonics())));
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const std::exception &) // of the integration: the other starts remain
  {
    return false;
  }
}

void BalanceSearch::begin(const PeriodicGuess &guess)
{
  guess_ = guess;
  const bool moves =
      guess.q.size() > 0 && guess.v.size() == guess.q.size() && !(guess.q.isZero(0.) && guess.v.isZero(0.));
  for (const bool more : {false, true})
  {
    if (more && harmonics_of(options_) > 0)
      break;
    constexpr int many_harmonics = 4; // times those that fail: the next motion may have more
    if (more)
      balance_.set_harmonics(many_harmonics * balance_.harmonics());
    if ((moves && solve_from_orbit(guess, false)) || (moves && solve_from(balance_.start_through(guess.q, guess.v))) ||
        solve_from(balance_.linear_start()) || solve_from_orbit(guess, true))
    {
      left_out_ = balance_.left_out(z_);
      return;
    }
  }
  check_memory();
  std::ostringstream message;
  message.precision(2);
  message << "harmonic balance: Newton's method with " << balance_.harmonics() << " harmonics reached a residual of "
          << newton_.residual << " of the motion after " << iterations_
          << " iterations; start closer to the solution, or use shooting or settling";
  throw ConvergenceFailure(message.str());
}

/// Past numbers of harmonics that have no solution; ends with the last one that has.
void BalanceSearch::grow()
{
  int tried = balance_.harmonics();
  while (harmonics_of(options_) == 0 && left_out_.motion > options_.tolerance && !problem_.interrupted())
  {
    tried = more_harmonics(problem_, tried);
    if (tried == 0)
      return;
    const int           before = balance_.harmonics();
    const VectorXd      z      = z_;
    const NewtonResult  newton = newton_;
    const FourierSeries motion = balance_.series(z_);
    balance_.set_harmonics(tried);
    const VectorXd start = balance_.pack(motion);
    if (!solve_from(start) && (problem_.interrupted() || !solve_from_orbit(guess_, true)))
    {
      if (!problem_.interrupted())
        failed_ += (failed_.empty() ? "" : ", ") + std::to_string(tried);
      balance_.set_harmonics(before);
      z_      = z;
      newton_ = newton;
      continue;
    }
    constexpr double another_motion = 0.3; // distance, of the unknowns: more harmonics change a motion less
    if ((z_ - start).norm() > another_motion * start.norm())
      others_ = "with fewer than " + std::to_string(tried) + " harmonics another solution was found than with these";
    left_out_ = balance_.left_out(z_);
  }
}

/// Few samples of a near jump feed back into the harmonics kept; a tenth of what these leave out is little enough.
void BalanceSearch::sample_finely()
{
  constexpr int most_samples = 16384; // of a period: kinks leave 1e-8 of their force then
  while (left_out_.samples > std::max(options_.tolerance, 0.1 * left_out_.motion) &&
         balance_.samples() < most_samples && !problem_.interrupted())
  {
    const auto before = std::pair(z_, newton_);
    balance_.set_harmonics(balance_.harmonics(), 2 * balance_.samples());
    if (!solve_from(before.first))
    {
      balance_.set_harmonics(balance_.harmonics(), balance_.samples() / 2);
      std::tie(z_, newton_) = before;
      return;
    }
    left_out_ = balance_.left_out(z_);
  }
}

void BalanceSearch::check_memory()
{
  const HarmonicForces::Memory memory     = balance_.memory(z_);
  constexpr double             remembered = 1e-9; // share of the force above which memory counts: above rounding
  if (!(memory.share > remembered))
    return;
  std::ostringstream message;
  message.precision(2);
  message << "harmonic balance: " << memory.element << " has hysteresis, by " << memory.share
          << " of the largest force: its force depends on the past; use shooting";
  throw std::invalid_argument(message.str());
}

PeriodicSolution BalanceSearch::solution()
{
  check_memory();
  PeriodicSolution solution = finished_balance(problem_, balance_, z_, newton_.residual, options_);
  solution.work.iterations  = iterations_;
  solution.notes.push_back(note_of_harmonics(balance_, left_out_, options_.tolerance, harmonics_of(options_) > 0));
  if (!failed_.empty())
    solution.notes.push_back("Newton's method did not converge with " + failed_ + " harmonics");
  if (!others_.empty())
    solution.notes.push_back(others_);
  return solution;
}

std::vector<PeriodicSolution> HarmonicBalanceMethod::solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                                           const PeriodicOptions &options) const
{
  if (const std::string reason = refuses(problem); !reason.empty())
    throw std::invalid_argument(reason);
  require_unknowns(problem, harmonics_of(options));
  PeriodicProblem own = problem;
  if (problem.period_is_unknown() && guess.period > 0.)
    own.period = guess.period;
  BalanceSearch search(own, options);
  search.begin(guess);
  search.grow();
  search.sample_finely();
  return {search.solution()};
}
} // namespace

const PeriodicMethod &harmonic_balance_method()
{
  static const HarmonicBalanceMethod method;
  return method;
}

} // namespace gestell::coupling
