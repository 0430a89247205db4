#pragma once

#include "coupling/periodic/periodic_method.h"

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

/// What a motion that does not repeat after a period is.
struct Recurrence
{
  std::string     kind;          ///< "sub-harmonic", "quasi-periodic", "chaotic"
  int             repeats  = 0;  ///< periods after which it does; 0: none up to the highest that is looked for
  double          exponent = 0.; ///< largest Lyapunov exponent [1/s], that of the shift in time left out
  Eigen::MatrixXd section{};     ///< q, q' at the begins of the periods [2n x periods] (Poincare)
};

/**
 * Follows a motion for many periods behind its transient and tells what it is:
 *
 *     exponent = 1/(K T) sum_k ln |Phi_k d_k| / |d_k|,     d_k+1 = Phi_k d_k / |Phi_k d_k|,
 *
 * the mean rate at which neighbours part (Benettin 1980).  Above zero by more than what the mean still wanders, it is
 * chaotic; sub-harmonic if it closes after some periods; else quasi-periodic.
 *
 * @param periods  that are followed, behind as many that are not
 */
Recurrence recurrence_of(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options,
                         int periods);

} // namespace gestell::coupling
