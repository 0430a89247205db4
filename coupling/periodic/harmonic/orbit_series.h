#pragma once

#include "coupling/periodic/period_flow.h"

namespace gestell::coupling
{

/**
 * Fourier series, of `harmonics` H, of the motion that leaves q, v at t_0 and is integrated over `period`.  What keeps
 * it from closing is spread over the period as a line, so that a motion near a periodic one begins a search for it.
 *
 * @throws ConvergenceFailure if it cannot be integrated
 */
FourierSeries orbit_series(const PeriodicProblem &problem, PeriodFlow &flow, const Eigen::VectorXd &q,
                           const Eigen::VectorXd &v, double period, int harmonics);

} // namespace gestell::coupling
