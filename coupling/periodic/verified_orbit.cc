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

/// Exact propagation by other formulas; of another method, that of [run], by finer steps.
MethodOptions other_integration(const MethodOptions &of_search)
{
  if (of_search.method != PeriodicOptions().integration.method)
  {
    MethodOptions    finer       = of_search;
    constexpr double finer_steps = 0.5; // of fixed steps
    finer.step *= finer_steps;
    constexpr double finer_errors = 0.1; // of a tolerance
    finer.tolerance *= finer_errors;
    return finer;
  }
  constexpr int other_order    = 6; // of exact propagation; searches take 8
  MethodOptions other          = options_of("exact", other_order).with("force", "collocation");
  other.modes                  = of_search.modes;
  constexpr double other_steps = 1e-9; // tolerance; searches take 1e-11
  other.tolerance              = other_steps;
  return other;
}

double largest_departure(const PeriodicSolution &solution)
{
  // departure of averaging, which takes first order of one mode: beyond it is another motion
  constexpr double off_a_mode = 0.5;
  if (!std::isfinite(solution.residual))
    return off_a_mode;
  const MethodOptions &steps = solution.integration;
  // departure of a Fourier series, whose harmonics are few, and of fixed steps
  constexpr double off_a_series = 0.1;
  if (solution.series || (steps.step > 0. && !controlled(steps)))
    return off_a_series;
  // departure of a motion that closes to 1e-7 at worst, with 20 periods of errors
  constexpr double goes_away = 1e-3;
  // errors of as many steps add up in a motion that is integrated with a tolerance
  constexpr double all_steps = 1e3;
  return std::clamp(all_steps * steps.tolerance, goes_away, off_a_series);
}

/// Motions of averaging have a period of first order where it is unknown: after 20 of them a run is elsewhere.
bool can_be_verified(const PeriodicProblem &problem, const PeriodicSolution &solution)
{
  return solution.stable() && (std::isfinite(solution.residual) || !problem.period_is_unknown()) &&
         solution.verification.periods == 0 && solution.verification.failure.empty();
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
  verification.leaves = !(verification.departure <= largest_departure(solution));
  std::ostringstream note;
  note.precision(2);
  if (verification.leaves)
    note << "not rated stable, although its multipliers are below 1: a run of " << verified_periods
         << " periods from its initial values deviates from it by " << verification.departure
         << " of its largest speed";
  else if (!verification.failure.empty())
    note << "not verified by a run of " << verified_periods << " periods, which ended after " << verification.periods
         << ": " << verification.failure;
  if (!note.str().empty())
    solution.notes.push_back(note.str());
}

namespace
{
/// Multipliers of an unstable motion by shorter steps, until they agree: where a motion is smooth its steps are long,
/// and tangents of long steps grow on stiff elements that hardly move.
void refine_unstable(const PeriodicProblem &problem, PeriodicSolution &solution)
{
  constexpr double longest = 1. / 256., shortest = longest / 256.; // steps, of a period: a quarter of those of a search
  constexpr double agree = 0.01;                                   // of the largest multiplier
  const double     given = solution.integration.step > 0. ? solution.integration.step : solution.period;
  try
  {
    for (double share = longest; share >= shortest && !solution.stable(); share *= 0.25)
    {
      MethodOptions finer = solution.integration;
      finer.step          = std::min(given, share * solution.period);
      PeriodFlow flow(problem, finer);
      if (!flow.has_tangents())
        return;
      const double before = solution.largest_multiplier();
      solution.multipliers =
          multipliers_of(flow.pass(solution.q, solution.v, solution.period, true).monodromy, problem);
      if (std::abs(solution.largest_multiplier() - before) <= agree * before)
        return;
    }
  }
  catch (const std::exception &)
  {
  } // as they were found
}
} // namespace

void verify_stable(const PeriodicProblem &problem, std::vector<PeriodicSolution> &solutions)
{
  for (PeriodicSolution &solution : solutions)
  {
    if (solution.stability_is_known() && !solution.stable() && solution.q.size() == problem.turn.size())
      refine_unstable(problem, solution);
    if (can_be_verified(problem, solution))
      verify_by_run(problem, solution);
  }
}

void verify_branch(const ProblemFamily &family, Branch &branch)
{
  std::vector<BranchPoint> &points = branch.points;
  // Whether a run leaves it.
  const auto left = [&](std::size_t i)
  {
    const FamilyMember member = family(points[i].parameter);
    if (can_be_verified(member.problem, points[i].solution))
      verify_by_run(member.problem, points[i].solution);
    return points[i].solution.verification.leaves;
  };
  for (std::size_t first = 0, end = 0; first < points.size(); first = end + 1)
  {
    end = first;
    while (end < points.size() && points[end].solution.stable())
      ++end;
    if (end == first)
      continue;
    const std::size_t probes[] = {first, first + (end - first) / 2, end - 1};
    if (std::any_of(std::begin(probes), std::end(probes), left))
      for (std::size_t i = first; i < end; ++i)
        left(i);
  }
}

} // namespace gestell::coupling
