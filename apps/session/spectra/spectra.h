#pragma once

#include "apps/output/values/spectrum.h"
#include "coupling/simulation/run_result.h"

#include <optional>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a sum of cosines, in a window after Hann:
///
///     A(k) = 2 / sum(w) |sum_j w_j (y_j - mean) exp(-2 pi i j k / n)|,   k = 0 .. n / 2.
///
/// @param samples  at equal distances, as many as a power of two
std::vector<double> hann_amplitudes(std::vector<double> samples);

/// Spectra over the whole run of the first forces, moments, accelerations and stresses, or else of the first signals:
/// at most six.  Histories of fewer than 256 rows have none.
std::optional<Spectra> spectra(const coupling::RunResult &run);

} // namespace gestell::apps
