#pragma once

#include "apps/analysis/life/life_result.h"
#include "apps/session/session.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Errors of modes and time at the worst place by two further runs: with half the step (a sixteenth of the tolerance)
 * and with half as many modes again, at least eight.  The life of the finer run over that of this one; time of a method
 * of order p: to the power 2^p/(2^p - 1), here 4/3 of order 2.
 *
 * @throws std::runtime_error if one does not come to its end
 */
void refine_error(Session &session, LifeResult &found);

/**
 * d ln(life) / d ln(key) at the worst place, by central differences of runs with the key changed by `share_of_key`.
 *
 * Differences over twice that distance show whether the life is smooth there: if both derivatives differ by more than
 * a percent of the larger one, cycles appear or vanish, or events change their order, which the note says.
 *
 * @param keys  a list as of `run --sensitivities`
 * @throws std::invalid_argument for wrong keys, std::runtime_error if a run does not come to its end
 */
std::vector<LifeDerivative> life_derivatives(Session &session, const LifeResult &found, const std::string &keys);

} // namespace gestell::apps
