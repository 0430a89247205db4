#pragma once

#include <vector>

namespace gestell::apps
{

/**
 * Half a period of the vibration of samples y(t) about an instant: the time between turning points beside the one at
 * `at`, of both sides the shorter one: a slow rise is no swing.  Turns smaller than a fifth of the range of y are
 * passed over.
 * @return 0 if it does not turn again on either side
 */
struct Swing
{
  double half = 0.;              ///< [s] half a period; 0: none
  double turn = 0., beside = 0.; ///< [s] the turning points it lies between, `turn` the one at the instant
};

Swing swing_at(const std::vector<double> &t, const std::vector<double> &y, double at);

/// Its duration.
double half_period_at(const std::vector<double> &t, const std::vector<double> &y, double at);

} // namespace gestell::apps
