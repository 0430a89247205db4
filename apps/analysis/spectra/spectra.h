#pragma once

#include "apps/analysis/spectra/spectrum_values.h"
#include "coupling/simulation/run_result.h"

#include <unsupported/Eigen/FFT>

#include <complex>
#include <optional>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a sum of cosines, with a Hann window w_j = (1 - cos(2 pi j / n)) / 2:
///
///     A(k) = 2 / sum(w) |sum_j w_j (y_j - mean) exp(-2 pi i j k / n)|,   k = 0 .. n / 2,
///
/// and half of this at k = n / 2, the Nyquist frequency, where the lines of positive and negative frequency coincide.
class HannSpectrum
{
public:
  /// @param n  number of samples; fast if it has no large prime factor
  explicit HannSpectrum(std::size_t n);

  /// @param samples  [n] equidistant
  std::vector<double> amplitudes(std::vector<double> samples);

private:
  std::vector<double>               window_;
  double                            sum_ = 0.;
  Eigen::FFT<double>                transform_; ///< keeps its factors from signal to signal
  std::vector<std::complex<double>> lines_;
};

/**
 * Spectra of the first forces, moments, accelerations and stresses, or else of the first signals, at most six.  They
 * cover the run, or the interval in which extremes are evaluated.  Histories of fewer than 256 rows have none.
 *
 * Rows at equal distances h are transformed directly.  A few rows at the end (fewer than 1 %) are dropped if the number
 * of rows has a prime factor above 97.  Lines go up to 1/(2 h).  Other rows are interpolated linearly to equal
 * distances and have lines up to 1/(4 h), where h is the mean distance.  If there are more than 8192 lines the highest
 * are omitted, which causes no aliasing because no row is dropped for it.  Motion faster than 1/(2 h) is aliased,
 * because rows are instantaneous values.
 */
/// @param from  [s] first row; a window of only one period has no other lines that the Hann window separates from the
///   harmonics
std::optional<Spectra> spectra(const coupling::RunResult &run, double from);

} // namespace gestell::apps
