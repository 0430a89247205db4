#pragma once

#include <vector>

namespace gestell::coupling
{

/// A signal over one period T as mean + ramp (t - t_0)/T + sum_k amplitude_k cos(k Omega t + phase_k).
struct SignalHarmonics
{
  double              mean = 0.; ///< of the samples, of what turns the ramp included
  double              ramp = 0.; ///< x(t_0 + T) - x(t_0)
  std::vector<double> amplitude; ///< of harmonic k + 1 of Omega
  std::vector<double> phase;     ///< [rad], above -pi up to pi
};

/**
 * Harmonics of a signal from N + 1 samples x(t_0 + i T/N), i = 0 ... N, by a fast transform; exact where none above N/2
 * is in it.
 *
 * @param samples  N + 1 of them, N a multiple of 4
 * @param begin    t_0 in periods: t_0/T
 * @param ratio    Omega in 2 pi/T: periods of the excitation in T
 * @param count    of harmonics of Omega, count ratio < N/2
 * @throws std::invalid_argument for another N or too many harmonics, with the number needed
 */
SignalHarmonics signal_harmonics(const std::vector<double> &samples, double begin, int ratio, int count);

struct SignalExtremes
{
  double min = 0., max = 0.;
};

/// Least and largest value over a period, by parabolas between samples where these bend alike; a kink and the ends of
/// what turns keep their samples.
/// @param samples  equally spaced, the last one a period behind the first
SignalExtremes signal_extremes(const std::vector<double> &samples);

} // namespace gestell::coupling
