#include "coupling/periodic/response/response_peaks.h"

#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

/// The highest place in [a, b].
double top(const std::function<double(double)> &f, double a, double b)
{
  constexpr double golden       = 0.6180339887498949; // (sqrt 5 - 1) / 2
  constexpr double width_of_top = 1e-8;               // relative: a parabola is flat to 1e-16 of its height there
  double           x = b - golden * (b - a), y = a + golden * (b - a), at_x = f(x), at_y = f(y);
  while (b - a > width_of_top * b)
    if (at_x < at_y)
    {
      a = x, x = y, at_x = at_y;
      at_y = f(y = a + golden * (b - a));
    }
    else
    {
      b = y, y = x, at_y = at_x;
      at_x = f(x = b - golden * (b - a));
    }
  return 0.5 * (a + b);
}

/// Where f falls through a level between `high`, where it is above, and `low`, where it is below.
double crossing(const std::function<double(double)> &f, double level, double high, double low)
{
  constexpr double width_of_side = 1e-7; // of the width of the peak, so of its damping
  const double     begin         = std::abs(high - low);
  while (std::abs(high - low) > width_of_side * std::min(begin, std::abs(high)) * 1e-2 && 0.5 * (high + low) != high &&
         0.5 * (high + low) != low)
  {
    const double middle               = 0.5 * (high + low);
    (f(middle) >= level ? high : low) = middle;
  }
  return 0.5 * (high + low);
}

/// Where |H| has fallen to a level on one side of a maximum; nan where it rises again before.
double flank(const std::function<double(double)> &f, double level, double peak, const std::vector<double> &frequencies,
             const std::vector<double> &samples, std::size_t i, int step)
{
  double inner = peak, last = std::numeric_limits<double>::infinity();
  for (;; i += std::size_t(step))
  {
    if (samples[i] > last * (1. + 1e-12))
      return std::nan("");
    if (samples[i] < level && (frequencies[i] - peak) * step > 0.)
      return crossing(f, level, inner, frequencies[i]);
    if ((frequencies[i] - peak) * step > 0.)
    {
      inner = frequencies[i];
      last  = samples[i];
    }
    if (step < 0 ? i == 0 : i + 1 == samples.size())
      return std::nan("");
  }
}

} // namespace

std::vector<ResponsePeak> response_peaks(const std::function<double(double)> &amplitude,
                                         const std::vector<double> &frequencies, const std::vector<double> &samples)
{
  const auto finite = [&](double f)
  {
    const double a = amplitude(f);
    return std::isfinite(a) ? a : std::numeric_limits<double>::max();
  };
  std::vector<ResponsePeak> peaks;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i)
  {
    if (!(samples[i] > samples[i - 1]) || !(samples[i] >= samples[i + 1]))
      continue;
    ResponsePeak peak;
    peak.frequency_hz         = top(finite, frequencies[i - 1], frequencies[i + 1]);
    peak.amplitude            = finite(peak.frequency_hz);
    const double level        = peak.amplitude / std::sqrt(2.);
    const double below        = flank(finite, level, peak.frequency_hz, frequencies, samples, i, -1),
                 above        = flank(finite, level, peak.frequency_hz, frequencies, samples, i, 1);
    peak.damping_ratio        = (above - below) / (2. * peak.frequency_hz);
    constexpr double undamped = 1e-7; // damping ratio that the width of the top leaves of none
    if (peak.damping_ratio < undamped)
    {
      peak.damping_ratio = 0.;
      peak.amplitude     = std::numeric_limits<double>::infinity();
    }
    peaks.push_back(peak);
  }
  return peaks;
}

} // namespace gestell::coupling
