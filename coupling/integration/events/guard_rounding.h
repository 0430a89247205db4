#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * By how much rounding moves the value of a guard,
 *
 *     16 eps (sum_j |dg/du_j| (|W|^T |q| + l)_j + |dg/du'_j| (|W|^T |q'|)_j + |dg/dt| |t|),
 *
 * l the size of the numbers whose difference the measures of an element are (ForceBlock::size).  A threshold is at most
 * as large as these terms and the guard itself, so that its rounding is told with them.
 *
 * @param integrator  tells q and q'
 * @param at          the begin of its last step
 * @return infinite for a guard that looks at accelerations, forces or multipliers: steps tell them, no begin does.
 */
double guard_rounding(const SecondOrderSystem &system, const TimeIntegrator &integrator, int guard,
                      const LocalState &at);

/// Whose guards are active, in their order.
std::vector<std::string> guard_owners(const EventSystem &events);

} // namespace gestell::coupling
