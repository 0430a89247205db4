#pragma once

#include "coupling/periodic/periodic_method.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Smallest integers in the ratio of nonzero values, within `tolerance` of each, up to 64 of the least one;
/// empty: there are none.
std::vector<int> whole_ratios(const std::vector<double> &values, double tolerance);

/// Least common period [s] of oscillations of omega [rad/s], 2 pi over their largest common divisor; 0: none.
double common_period(const std::vector<double> &omega);

/**
 * Travel of coordinates in `time` [s] from q, q' at t_0 without reversal [n]; 0: oscillating ones.
 *
 * @throws ConvergenceFailure, SearchInterrupted
 */
Eigen::VectorXd advance_of(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                           double begin, double time, const std::atomic<bool> *stop);

/// A free or self-excited oscillation.
struct FreeOscillation
{
  PeriodicGuess at;                  ///< on it, with its period
  int           phase       = -1;    ///< the coordinate that moves most
  double        phase_value = 0.;    ///< its middle, through which `at` rises
  bool          falls       = false; ///< `at` falls through it, as something sticks where it rises
  bool          pushed      = false; ///< the initial state is at rest and got a small velocity
};

/**
 * The oscillation of an autonomous system: integrated from q, q' until the largest excursions over many periods of its
 * lowest frequency are constant; its period is that of the state at passages of the dominant coordinate. It must return
 * after an increase by a tenth.
 *
 * @throws NoPeriodicMotion if it comes to rest, keeps any size or none; ConvergenceFailure
 */
FreeOscillation free_oscillation(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                                 double begin, const std::atomic<bool> *stop);

} // namespace gestell::coupling
