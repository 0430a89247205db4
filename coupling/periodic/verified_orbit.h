#pragma once

#include "coupling/periodic/continuation.h"
#include "coupling/periodic/followed_equations.h"

namespace gestell::coupling
{

/// of a run that verifies a motion: a multiplier of 1.4 enlarges what it is off by 800 times in them
constexpr int verified_periods = 20;

/**
 * Runs the system from the initial values of a motion for 20 periods and stores the largest departure in
 * solution.verification: angles are not reset, and the steps differ from those of the search.
 *
 *     d_k = |S (x(t_0 + k T) - x(t_0) - k turn)| / max_t |q'|,     x = (q, q'),  S = diag(2 pi/T, 1),  k = 1 ... 20,
 *
 * without its share along free shifts and, where the period is unknown, along the motion itself, in which the errors of
 * the steps add up.  A motion with multipliers mu, |mu| < 1, stays: errors e of a period sum to e/(1 - |mu|), and to
 * 20 e at most.  A solution that is periodic only by assumptions of the search departs at once. The history of elements
 * is reset in every period, as in the search (PeriodicProblem). Cost: 20 periods without tangents.
 */
void verify_by_run(const PeriodicProblem &problem, PeriodicSolution &solution);

/// Those that are stable by their multipliers, unless they are verified already; by averaging only those of a given
/// period.  The multipliers of the others are those of shorter steps.
void verify_stable(const PeriodicProblem &problem, std::vector<PeriodicSolution> &solutions);

/// Of each stretch of a branch without a motion that is unstable the first one, the middle one and the last; all of it,
/// where a run leaves one of them.
void verify_branch(const ProblemFamily &family, Branch &branch);

} // namespace gestell::coupling
