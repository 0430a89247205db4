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
 * How far coordinates go in `time` [s] from q, q' at t_0 without ever turning back [n]; 0: one that swings.
 *
 * @throws ConvergenceFailure, SearchInterrupted
 */
Eigen::VectorXd advance_of(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                           double begin, double time, const std::atomic<bool> *stop);

/// An oscillation that goes on by itself.
struct FreeOscillation
{
  PeriodicGuess at;                  ///< on it, with its period
  int           phase       = -1;    ///< the coordinate that moves most
  double        phase_value = 0.;    ///< its middle, through which `at` rises
  bool          falls       = false; ///< `at` falls through it, as something sticks where it rises
  bool          pushed      = false; ///< the start rests, and was given a small velocity
};

/**
 * What a system does by itself, to which nothing tells the time: followed from q, q' until the largest excursions of a
 * time of many periods of its lowest frequency are those of the time before, then its period is that after which the
 * state comes back at a passage of the coordinate that moves most.  From a tenth more it must come back.
 *
 * @throws NoPeriodicMotion if it comes to rest, keeps any size or none; ConvergenceFailure
 */
FreeOscillation free_oscillation(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                                 double begin, const std::atomic<bool> *stop);

} // namespace gestell::coupling
