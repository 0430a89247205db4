#pragma once

#include <functional>
#include <vector>

namespace gestell::coupling
{

/// A resonance of a frequency response.
struct ResponsePeak
{
  double frequency_hz = 0.;
  double amplitude    = 0.; ///< |H|, infinite of an undamped mode
  /// (f_2 - f_1)/(2 f) between the frequencies where |H| has fallen by the root of two; nan where it does not fall so
  /// far between its neighbours, 0 of an undamped mode.
  double damping_ratio = 0.;
};

/**
 * Peaks of |H| between the first and the last of the frequencies, ascending: each local maximum among the samples,
 * followed to its top and down its flanks.
 *
 * @param amplitude    |H| at a frequency [Hz]; what is not finite counts as infinite
 * @param frequencies  [Hz] ascending, so dense that no peak lies between two of them
 * @param samples      |H| at these
 */
std::vector<ResponsePeak> response_peaks(const std::function<double(double)> &amplitude,
                                         const std::vector<double> &frequencies, const std::vector<double> &samples);

} // namespace gestell::coupling
