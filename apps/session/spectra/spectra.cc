#include "apps/session/spectra/spectra.h"

#include "fem/values/two_pi.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>

namespace gestell::apps
{

namespace
{

constexpr std::size_t fewest_rows = 256, most_samples = 16384, most_spectra = 6;

/// Column j at n instants at equal distances over the run, on straight lines between its rows.
std::vector<double> evenly(const coupling::RunResult &run, std::size_t j, std::size_t n)
{
  const std::size_t   width = run.columns.size(), rows = run.rows.size() / width;
  const auto          at    = [&](std::size_t i, std::size_t column) { return run.rows[i * width + column]; };
  const double        first = at(0, 0), step = (at(rows - 1, 0) - first) / static_cast<double>(n);
  std::vector<double> samples;
  for (std::size_t k = 0, i = 0; k < n; ++k)
  {
    const double t = first + static_cast<double>(k) * step;
    while (i + 2 < rows && at(i + 1, 0) <= t)
      ++i;
    const double length = at(i + 1, 0) - at(i, 0), share = length > 0. ? (t - at(i, 0)) / length : 0.;
    samples.push_back(at(i, j) + share * (at(i + 1, j) - at(i, j)));
  }
  return samples;
}

bool shakes(const std::string &unit)
{
  return unit == "N" || unit == "N m" || unit == "m/s^2" || unit == "Pa";
}

/// Columns of signals, not those of the energy at the end.
std::vector<std::size_t> chosen_columns(const coupling::RunResult &run)
{
  std::vector<std::size_t> chosen, others;
  for (std::size_t j = 1; j <= run.signals.size() && j < run.columns.size(); ++j)
    (shakes(run.units[j]) ? chosen : others).push_back(j);
  if (chosen.empty())
    chosen = others;
  chosen.resize(std::min(chosen.size(), most_spectra));
  return chosen;
}

} // namespace

std::vector<double> hann_amplitudes(std::vector<double> samples)
{
  const std::size_t   n = samples.size();
  std::vector<double> window(n);
  double              sum = 0., mean = 0.;
  for (std::size_t j = 0; j < n; ++j)
  {
    window[j] = 0.5 - 0.5 * std::cos(two_pi * static_cast<double>(j) / static_cast<double>(n));
    sum += window[j];
    mean += window[j] * samples[j];
  }
  mean /= sum;
  for (std::size_t j = 0; j < n; ++j)
    samples[j] = window[j] * (samples[j] - mean);
  std::vector<std::complex<double>> lines;
  Eigen::FFT<double>                transform;
  transform.fwd(lines, samples);
  std::vector<double> amplitudes;
  for (std::size_t k = 0; k <= n / 2; ++k)
    amplitudes.push_back(2. / sum * std::abs(lines[k]));
  return amplitudes;
}

std::optional<Spectra> spectra(const coupling::RunResult &run)
{
  const std::size_t width = run.columns.size(), rows = width > 0 ? run.rows.size() / width : 0;
  if (rows < fewest_rows || !run.failure.empty())
    return std::nullopt;
  std::size_t n = fewest_rows;
  while (2 * n <= std::min(rows, most_samples))
    n *= 2;
  Spectra result;
  result.begin         = run.rows.front();
  result.end           = run.rows[(rows - 1) * width];
  result.samples       = static_cast<int>(n);
  result.resolution_hz = 1. / (result.end - result.begin);
  if (!(result.end > result.begin))
    return std::nullopt;
  for (const std::size_t j : chosen_columns(run))
  {
    const std::vector<double> samples = evenly(run, j, n);
    if (std::all_of(samples.begin(), samples.end(), [](double y) { return std::isfinite(y); }))
      result.signals.push_back({run.columns[j], run.units[j], hann_amplitudes(samples)});
  }
  return result.signals.empty() ? std::nullopt : std::optional(result);
}

} // namespace gestell::apps
