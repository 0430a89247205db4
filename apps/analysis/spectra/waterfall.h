#pragma once

#include "apps/analysis/spectra/spectrum_values.h"
#include "coupling/simulation/run_result.h"

namespace gestell::apps
{

/// Input of a waterfall: rows of a history in ascending time, and the rotor speed [1/min] at them.
struct TurningHistory
{
  std::vector<double> t, speed_rpm;
};

/**
 * Spectra of a signal over the speed of a rotor: amplitudes in Hann windows around the instants at which the speed
 * first reaches equidistant values,
 *
 *     A(f) = 2 / sum(w) |sum w (y - mean) exp(-i 2 pi f t)|,
 *
 * The length of a window is a twelfth of the run, but at least six revolutions at the highest speed.
 *
 * @param highest  [Hz] of the spectra
 * @return without windows if the speed changes by less than a fifth
 */
Waterfall waterfall(const std::string &name, const std::string &unit, const TurningHistory &history,
                    const std::vector<double> &y, double highest);

} // namespace gestell::apps
