#include "apps/analysis/spectra/spectra.h"

#include "apps/session/history_rows.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gestell::apps
{

namespace
{

/// Whether a transform of that length is fast.
bool is_fast(std::size_t n)
{
  for (std::size_t p = 2; p <= 97; ++p)
    while (n % p == 0)
      n /= p;
  return n == 1;
}

/// Equidistant instants (distance h) at which signals are sampled.
struct SpectrumWindow
{
  double      begin = 0., h = 0.;
  double      row_step = 0.; ///< mean distance of rows
  std::size_t n        = 0;
  bool        on_rows  = false; ///< the instants coincide with rows

  double t(std::size_t k) const { return begin + static_cast<double>(k) * h; }
};

/// Rows at equal distances from the first on; the last one of a run may lie closer.
std::size_t even_rows(const HistoryRows &rows)
{
  const double h = (rows.t(rows.size() - 2) - rows.t(0)) / static_cast<double>(rows.size() - 2);
  // relative to the distance of rows: output times are multiples of it up to rounding, events are at any time
  constexpr double even = 1e-6;
  std::size_t      i    = 1;
  while (i < rows.size() && std::abs(rows.t(i) - rows.t(0) - static_cast<double>(i) * h) <= even * h)
    ++i;
  return i;
}

SpectrumWindow window_of(const HistoryRows &rows)
{
  SpectrumWindow    window{rows.t(0)};
  const std::size_t on_grid = even_rows(rows);
  window.on_rows            = on_grid + 1 >= rows.size();
  const std::size_t last    = (window.on_rows ? on_grid : rows.size()) - 1;
  window.row_step           = (rows.t(last) - window.begin) / static_cast<double>(last);
  window.h                  = window.row_step;
  for (window.n = last; window.on_rows && !is_fast(window.n);)
    --window.n;
  while (!is_fast(window.n))
    ++window.n;
  if (!window.on_rows)
    window.h = (rows.t(last) - window.begin) / static_cast<double>(window.n);
  return window;
}

/// Column j at the instants of the window, on straight lines between the rows where there are none.
std::vector<double> samples_of(const HistoryRows &rows, std::size_t j, const SpectrumWindow &window)
{
  std::vector<double> samples;
  for (std::size_t k = 0, i = 0; k < window.n; ++k)
  {
    while (i + 2 < rows.size() && rows.t(i + 1) <= window.t(k))
      ++i;
    const double length = rows.t(i + 1) - rows.t(i), share = length > 0. ? (window.t(k) - rows.t(i)) / length : 0.;
    samples.push_back(window.on_rows ? rows.at(k, j) : rows.at(i, j) + share * (rows.at(i + 1, j) - rows.at(i, j)));
  }
  return samples;
}

bool shakes(const std::string &unit)
{
  return unit == "N" || unit == "N m" || unit == "m/s^2" || unit == "Pa";
}

/// Columns of signals, without those of the energy at the end.
std::vector<std::size_t> chosen_columns(const coupling::RunResult &run)
{
  std::vector<std::size_t> chosen, others;
  for (std::size_t j = 1; j <= run.signals.size() && j < run.columns.size(); ++j)
    (shakes(run.units[j]) ? chosen : others).push_back(j);
  if (chosen.empty())
    chosen = others;
  constexpr std::size_t most_spectra = 6; // chosen: curves of one chart
  chosen.resize(std::min(chosen.size(), most_spectra));
  return chosen;
}

} // namespace

HannSpectrum::HannSpectrum(std::size_t n) : window_(n)
{
  for (std::size_t j = 0; j < n; ++j)
    window_[j] = 0.5 - 0.5 * std::cos(two_pi * static_cast<double>(j) / static_cast<double>(n));
  sum_ = std::accumulate(window_.begin(), window_.end(), 0.);
}

std::vector<double> HannSpectrum::amplitudes(std::vector<double> samples)
{
  const std::size_t n    = samples.size();
  const double      mean = std::inner_product(window_.begin(), window_.end(), samples.begin(), 0.) / sum_;
  for (std::size_t j = 0; j < n; ++j)
    samples[j] = window_[j] * (samples[j] - mean);
  transform_.fwd(lines_, samples);
  std::vector<double> amplitudes;
  for (std::size_t k = 0; k <= n / 2; ++k) // half the rate is its own mirror image
    amplitudes.push_back((2 * k == n ? 1. : 2.) / sum_ * std::sqrt(std::norm(lines_[k])));
  return amplitudes;
}

std::optional<Spectra> spectra(const coupling::RunResult &run, double from)
{
  const HistoryRows     rows(run, from);
  constexpr std::size_t fewest_rows = 256;  // 128 lines: fewer show no spectrum
  constexpr std::size_t most_lines  = 8192; // twelve for each pixel of a chart
  if (rows.size() < fewest_rows || !run.failure.empty() || !(rows.t(rows.size() - 1) > rows.t(0)))
    return std::nullopt;
  const SpectrumWindow window = window_of(rows);
  Spectra              result;
  result.begin         = window.begin;
  result.end           = window.t(window.n);
  result.samples       = static_cast<int>(window.n);
  result.resolution_hz = 1. / (result.end - result.begin);
  result.row_step      = window.row_step;
  result.carried_hz    = (window.on_rows ? 0.5 : 0.25) / window.row_step;
  HannSpectrum      spectrum(window.n);
  const std::size_t lines = std::min(most_lines, window.on_rows ? window.n / 2 : window.n / 4);
  for (const std::size_t j : chosen_columns(run))
  {
    const std::vector<double> samples = samples_of(rows, j, window);
    if (!std::all_of(samples.begin(), samples.end(), [](double y) { return std::isfinite(y); }))
      continue;
    result.signals.push_back({run.columns[j], run.units[j], spectrum.amplitudes(samples)});
    result.signals.back().amplitudes.resize(lines + 1);
  }
  return result.signals.empty() ? std::nullopt : std::optional(result);
}

} // namespace gestell::apps
