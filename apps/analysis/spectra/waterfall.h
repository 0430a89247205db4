#pragma once

#include "apps/analysis/spectra/spectrum_values.h"
#include "coupling/simulation/run_result.h"

namespace gestell::apps
{

/// What a waterfall is made of: rows of a history by ascending time, and the speed of the rotor [1/min] over it.
struct TurningHistory
{
  std::vector<double> t, speed_rpm;
};

/**
 * Spectra of a signal over the speed of a rotor: amplitudes in windows after Hann about the instants at which the speed
 * first reaches equidistant values,
 *
 *     A(f) = 2 / sum(w) |sum w (y - mean) exp(-i 2 pi f t)|,
 *
 * a window as long as a twelfth of the run, but six turns at the highest speed at least.
 *
 * @param highest  [Hz] of the spectra
 * @return without windows if the speed changes by less than a fifth
 */
Waterfall waterfall(const std::string &name, const std::string &unit, const TurningHistory &history,
                    const std::vector<double> &y, double highest);

} // namespace gestell::apps
