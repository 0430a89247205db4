#pragma once

#include "apps/analysis/spectra/spectrum_values.h"
#include "coupling/simulation/run_result.h"

#include <optional>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a sum of cosines, in a Hann window:
///
///     A(k) = 2 / sum(w) |sum_j w_j (y_j - mean) exp(-2 pi i j k / n)|,   k = 0 .. n / 2,
///
/// and half of it at k = n / 2, half the rate of the samples, where lines from below and above are one.
///
/// @param samples  at equal distances; fast where their number has no large prime factor
std::vector<double> hann_amplitudes(std::vector<double> samples);

/**
 * Spectra over the run, or from where extremes count, of the first forces, moments, accelerations and stresses, or else
 * of the first signals: at most six.  Histories of fewer than 256 rows have none.
 *
 * Rows at equal distances h are transformed as they are, all of them but for the few at the end (fewer than one in a
 * hundred) that leave a number without prime factors above 97, and have lines up to 1/(2 h).  Others are sampled anew
 * on their straight lines and have lines up to 1/(4 h), h being the mean distance.  Above 8192 lines the highest are
 * left out: they do not fold, since no row was.  Motion faster than 1/(2 h) folds, as rows are instants.
 */
/// @param from  [s] rows from there on; a window of one period alone has no line beside its harmonics that Hann keeps
/// apart
std::optional<Spectra> spectra(const coupling::RunResult &run, double from);

} // namespace gestell::apps
