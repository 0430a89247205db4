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
 * Rounding error of the value of a guard (event function),
 *
 *     16 eps (sum_j |dg/du_j| (|W|^T |q| + l)_j + |dg/du'_j| (|W|^T (|q'| + |q|/h))_j + |dg/dt| |t|),
 *
 * where l is the size of the numbers whose difference the measures of an element are (ForceBlock::size).  A threshold
 * is at most as large as these terms and the guard itself, so that its rounding is included.
 *
 * @param integrator  provides q and q'
 * @param at          the start of its last step
 * @param h           [s] length of the step whose rates are differences of q
 * @return infinite for a guard that depends on accelerations, forces or multipliers, which are known only after a step
 */
double guard_rounding(const SecondOrderSystem &system, const TimeIntegrator &integrator, int guard,
                      const LocalState &at, double h = std::numeric_limits<double>::infinity());

/// Whether the values of a guard within a step are only rounding errors, so that their sign means nothing.
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

/// Owners of the active guards, in their order.
std::vector<std::string> guard_owners(const EventSystem &events);

} // namespace gestell::coupling
