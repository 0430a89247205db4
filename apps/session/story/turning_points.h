#pragma once

#include <vector>

namespace gestell::apps
{

/// A half-cycle of a signal, from one turning point to the next.
struct Swing
{
  double half = 0.;              ///< [s] half a period; 0: none
  double turn = 0., nearby = 0.; ///< [s] its turning points, `turn` is the one at the given instant
};

/**
 * Half-cycle of the samples y(t) at an instant: between the turning point at `at` and the nearer of its two neighbours,
 * so that a slow rise is not taken for a half-cycle.  Oscillations smaller than a fifth of the range of y are ignored.
 * @return half = 0 if there is no turning point at `at`, or none before and after it
 */
Swing swing_at(const std::vector<double> &t, const std::vector<double> &y, double at);

/// Duration [s] of this half-cycle.
double half_period_at(const std::vector<double> &t, const std::vector<double> &y, double at);

} // namespace gestell::apps
