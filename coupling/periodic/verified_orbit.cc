#include "coupling/periodic/verified_orbit.h"

#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

constexpr int    other_order  = 6;    ///< of exact propagation; searches take 8
constexpr double other_steps  = 1e-9; ///< tolerance; searches take 1e-11
constexpr double goes_away    = 1e-3; ///< departure of a motion that closes to 1e-7 at worst, with 20 periods of errors
constexpr double off_a_series = 0.1;  ///< the same of a Fourier series, whose harmonics are few

MethodOptions other_integration(const MethodOptions &of_search)
{
  if (of_search.method != PeriodicOptions().integration.method)
    return of_search; // that of [run], for what exact propagation does not integrate
  MethodOptions other = options_of("exact", other_order).with("force", "collocation");
  other.modes         = of_search.modes;
  other.tolerance     = other_steps;
  return other;
}

/// x without its share along a direction.
VectorXd across(const VectorXd &x, const VectorXd &direction)
{
  const double square = direction.squaredNorm();
  return square > 0. ? VectorXd(x - direction.dot(x) / square * direction) : x;
}
} // namespace

void verify_by_run(const PeriodicProblem &problem, PeriodicSolution &solution)
{
  PeriodicProblem own = problem;
  own.period          = solution.period;
  own.turn            = solution.turn;
  PeriodFlow       flow(own, other_integration(solution.integration));
  RunVerification &verification = solution.verification;
  const Index      n            = solution.q.size();
  const double     T = solution.period, omega = 2. * M_PI / T;
  VectorXd         q = solution.q, v = solution.v, x(2 * n), rate(2 * n);
  double           fastest = 0., departure = 0.;
  try
  {
    for (int k = 1; k <= verified_periods; ++k)
    {
      const double         begin   = solution.begin + (k - 1) * T;
      const PeriodPassage &passage = flow.pass_part(q, v, begin, begin + T, false);
      q                            = passage.q;
      v                            = passage.v;
      fastest                      = std::max(fastest, passage.fastest);
      solution.work.add({0, 1, passage.work});
      verification.starts_anew = flow.remembers_at_end() || verification.starts_anew;
      x << omega * without_free(own, q - solution.q - k * solution.turn), v - solution.v;
      if (own.period_is_unknown())
      {
        rate << omega * without_free(own, v), flow.end_acceleration();
        x = across(x, rate);
      }
      departure              = std::max(departure, x.norm());
      verification.periods   = k;
      verification.departure = departure > 0. ? departure / fastest : 0.;
    }
  }
  catch (const SearchInterrupted &)
  {
    verification.failure = "interrupted";
  }
  catch (const std::exception &none)
  {
    verification.failure = none.what();
  }
  verification.leaves = !(verification.departure <= (solution.series ? off_a_series : goes_away));
  std::ostringstream note;
  note.precision(2);
  if (verification.leaves)
    note << "not called stable, although its multipliers are below 1: a run of " << verified_periods
         << " periods from its initial values deviates from it by " << verification.departure
         << " of its largest speed";
  else if (!verification.failure.empty())
    note << "not verified by a run of " << verified_periods << " periods, which ended after " << verification.periods
         << ": " << verification.failure;
  if (!note.str().empty())
    solution.notes.push_back(note.str());
}

void verify_stable(const PeriodicProblem &problem, std::vector<PeriodicSolution> &solutions)
{
  for (PeriodicSolution &solution : solutions)
    if (solution.stable() && std::isfinite(solution.residual) && solution.verification.periods == 0 &&
        solution.verification.failure.empty())
      verify_by_run(problem, solution);
}

} // namespace gestell::coupling
