#pragma once

#include <vector>

namespace gestell::apps
{

/// From one turning point of a signal to the next.
struct Swing
{
  double half = 0.;              ///< [s] half a period; 0: none
  double turn = 0., nearby = 0.; ///< [s] the turning points it lies between, `turn` the one at the instant
};

/**
 * Half a period of the vibration of samples y(t) about an instant: between the turning point at `at` and one beside it,
 * of both sides the nearer one: a slow rise is no swing.  Turns smaller than a fifth of the range of y are passed over.
 * @return half = 0 if it does not turn, or not again on either side
 */
Swing swing_at(const std::vector<double> &t, const std::vector<double> &y, double at);

/// Its duration.
double half_period_at(const std::vector<double> &t, const std::vector<double> &y, double at);

} // namespace gestell::apps
