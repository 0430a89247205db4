#pragma once

#include "apps/analysis/life/life_load.h"
#include "apps/analysis/life/life_result.h"
#include "apps/session/session.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Errors of modes and time at the worst place by further runs, with the second models of the budget of outputs: `exact`
 * or half the step (a sixteenth of the tolerance), and twice as many modes, at least eight more.  The logarithm of the
 * life of the finer run over that of this one, times 4/3 for half the step of a method of order 2, and times
 * truncation_factor() for the modes.
 *
 * @throws std::runtime_error if one does not come to its end
 */
void refine_error(Session &session, const LifeLoad &load, LifeResult &found);

/**
 * d ln(life) / d ln(key) at the worst place, by differences of runs with the key changed by -2, -1, 1 and 2 steps h of
 * half a percent, all integrated finer than the run itself and with extremes between samples, docs/theory/life.md (11):
 *
 *     (4 d(h) - d(2 h)) / 3,   d(h) = (ln life(h) - ln life(-h)) / (2 h).
 *
 * Its error is |d(h) - d(2 h)| / 3, and what the fourth difference shows of the noise of the runs.  A note says if
 * cycles appear or vanish between the runs, and where there is no derivative.
 *
 * @param keys  a list as of `run --sensitivities`
 * @throws std::invalid_argument for wrong keys, std::runtime_error if the finer run does not come to its end
 */
std::vector<LifeDerivative> life_derivatives(Session &session, const LifeResult &found, const std::string &keys);

} // namespace gestell::apps
