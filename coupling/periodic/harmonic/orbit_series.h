#pragma once

#include "coupling/periodic/period_flow.h"

namespace gestell::coupling
{

/**
 * Fourier series, of `harmonics` H, of the motion that starts at q, v at t_0, integrated over `period`. Its gap is
 * distributed linearly over the period, for the start of a search near a periodic solution.
 *
 * @throws ConvergenceFailure if it cannot be integrated
 */
FourierSeries orbit_series(const PeriodicProblem &problem, PeriodFlow &flow, const Eigen::VectorXd &q,
                           const Eigen::VectorXd &v, double period, int harmonics);

} // namespace gestell::coupling
