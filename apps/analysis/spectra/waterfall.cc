#include "apps/analysis/spectra/waterfall.h"

#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace gestell::apps
{

namespace
{

constexpr int n_frequencies = 240; ///< points of a curve that is 640 pixels wide

double linear(const std::vector<double> &x, const std::vector<double> &y, double at)
{
  const auto        upper = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const std::size_t i     = std::size_t(std::clamp<std::ptrdiff_t>(upper, 1, std::ptrdiff_t(x.size()) - 1));
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// Instants at which the speed first reaches equidistant values between its ends, each with room for a window.
std::vector<double> instants(const TurningHistory &history, double low, double high, double length)
{
  std::vector<double> found;
  constexpr int       n_windows = 30; // curves of a picture that can be distinguished
  for (int k = 0; k < n_windows; ++k)
  {
    const double level = low + (high - low) * (k + 0.5) / n_windows;
    for (std::size_t i = 1; i < history.t.size(); ++i)
      if ((history.speed_rpm[i - 1] - level) * (history.speed_rpm[i] - level) <= 0.)
      {
        const double t = history.t[i];
        if (t - 0.5 * length >= history.t.front() && t + 0.5 * length <= history.t.back())
          found.push_back(t);
        break;
      }
  }
  return found;
}

/// Number of samples in a window equal to that of its rows, so that nothing they resolve is aliased.
int samples_of_window(double row_step, double length)
{
  constexpr int fewest_samples = 1024;    // four for each frequency
  constexpr int most_samples   = 1 << 16; // of a window: each of its frequencies takes as many products
  return int(std::clamp(std::ceil(length / row_step), double(fewest_samples), double(most_samples)));
}

/// Amplitudes [n_frequencies] at multiples of `step` [Hz] about an instant.
std::vector<double> spectrum(const TurningHistory &history, const std::vector<double> &y, double middle, double length,
                             double step, int window_samples)
{
  std::vector<double> samples(static_cast<std::size_t>(window_samples)), weights(samples);
  double              sum = 0., mean = 0.;
  for (int i = 0; i < window_samples; ++i)
  {
    const double share      = (i + 0.5) / window_samples;
    samples[std::size_t(i)] = linear(history.t, y, middle + (share - 0.5) * length);
    weights[std::size_t(i)] = 0.5 - 0.5 * std::cos(two_pi * share);
    sum += weights[std::size_t(i)];
    mean += weights[std::size_t(i)] * samples[std::size_t(i)];
  }
  mean /= sum;
  std::vector<double> amplitudes;
  for (int k = 1; k <= n_frequencies; ++k)
  {
    const std::complex<double> turn  = std::polar(1., -two_pi * k * step * length / window_samples);
    std::complex<double>       phase = 1., total = 0.;
    for (std::size_t i = 0; i < samples.size(); ++i, phase *= turn)
      total += weights[i] * (samples[i] - mean) * phase;
    amplitudes.push_back(2. * std::abs(total) / sum);
  }
  return amplitudes;
}

} // namespace

Waterfall waterfall(const std::string &name, const std::string &unit, const TurningHistory &history,
                    const std::vector<double> &y, double highest)
{
  Waterfall result;
  result.name                   = name;
  result.unit                   = unit;
  const auto [low, high]        = std::minmax_element(history.speed_rpm.begin(), history.speed_rpm.end());
  constexpr double least_change = 0.2;      // of the highest speed: within less, orders do not cross frequencies
  constexpr double window_share = 1. / 12.; // of the run: a window in which speeds differ little
  constexpr double fewest_turns = 6.; // at the highest speed: the window separates its first order from adjacent ones
  if (!(*high > 0.) || *high - *low < least_change * *high)
    return result;
  const double     length = std::max(window_share * (history.t.back() - history.t.front()), fewest_turns * 60. / *high);
  const double     row_step      = (history.t.back() - history.t.front()) / double(history.t.size() - 1);
  const int        n             = samples_of_window(row_step, length);
  const double     rate          = std::min(1. / row_step, n / length); ///< [Hz] of the rows or the samples
  constexpr double below_nyquist = 0.8; // of half the rate: linear interpolation between rows damps what is above
  const double     step          = std::min(highest, 0.5 * below_nyquist * rate) / n_frequencies;
  for (int k = 1; k <= n_frequencies; ++k)
    result.frequencies_hz.push_back(k * step);
  for (const double t : instants(history, *low, *high, length))
  {
    result.speed_rpm.push_back(linear(history.t, history.speed_rpm, t));
    result.amplitudes.push_back(spectrum(history, y, t, length, step, n));
  }
  return result;
}

} // namespace gestell::apps
