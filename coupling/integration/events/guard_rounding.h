#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * By how much rounding moves the value of a guard,
 *
 *     16 eps (sum_j |dg/du_j| (|W|^T |q| + l)_j + |dg/du'_j| (|W|^T (|q'| + |q|/h))_j + |dg/dt| |t|),
 *
 * l the size of the numbers whose difference the measures of an element are (ForceBlock::size).  A threshold is at most
 * as large as these terms and the guard itself, so that its rounding is told with them.
 *
 * @param integrator  tells q and q'
 * @param at          the begin of its last step
 * @param h           [s] length of the step whose rates are differences of q
 * @return infinite for a guard that looks at accelerations, forces or multipliers: steps tell them, no begin does.
 */
double guard_rounding(const SecondOrderSystem &system, const TimeIntegrator &integrator, int guard,
                      const LocalState &at, double h = std::numeric_limits<double>::infinity());

/// Values of a guard within a step are all rounding, so that their sign tells nothing: what it looks at is at rest.
template <class Looks>
bool is_rounding(const SecondOrderSystem &system, const TimeIntegrator &integrator, int guard, const LocalState &at,
                 const Looks &looks)
{
  double most = 0.;
  for (const Eigen::VectorXd &look : looks)
    most = std::max(most, std::abs(look[guard]));
  const double rounding = guard_rounding(system, integrator, guard, at, integrator.time() - integrator.step_begin());
  return most <= rounding && std::isfinite(rounding);
}

/// Whose guards are active, in their order.
std::vector<std::string> guard_owners(const EventSystem &events);

} // namespace gestell::coupling
