#include "coupling/periodic/harmonic/signal_harmonics.h"

#include "coupling/periodic/harmonic/fourier_transform.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

/// The extreme of the parabola through three samples about the middle one, where it is one: the samples bend alike
/// there as beside, and do not at a kink.
double vertex(double x_2, double x_1, double x0, double x1, double x2)
{
  constexpr double alike = 2.; // ratio of bends beside each other: a smooth extreme has nearly one, a kink has none
  const double     bend = x1 - 2. * x0 + x_1, left = x0 - 2. * x_1 + x_2, right = x2 - 2. * x1 + x0;
  for (const double nearby : {left, right})
    if (!(nearby * bend > 0.) || std::abs(nearby) > alike * std::abs(bend) || std::abs(bend) > alike * std::abs(nearby))
      return x0;
  if (std::abs(x1 - x_1) > std::abs(bend)) // an end of what turns, not its extreme
    return x0;
  return x0 - (x1 - x_1) * (x1 - x_1) / (8. * bend);
}

} // namespace

SignalHarmonics signal_harmonics(const std::vector<double> &samples, double begin, int ratio, int count)
{
  const int n = int(samples.size()) - 1;
  if (2 * count * ratio >= n)
    throw std::invalid_argument("signal_harmonics: " + std::to_string(n) +
                                " samples of a period do not resolve harmonic " + std::to_string(count * ratio) +
                                "; give more than " + std::to_string(2 * count * ratio));
  const FourierTransform transform(n);
  SignalHarmonics        result;
  result.mean = std::accumulate(samples.begin(), samples.end() - 1, 0.) / n;
  result.ramp = samples.back() - samples.front();
  std::vector<double> rest(samples.begin(), samples.end() - 1);
  for (int i = 0; i < n; ++i)
    rest[std::size_t(i)] -=
        result.mean + result.ramp * i / n; // so that a large mean or ramp costs the harmonics no digits
  Eigen::VectorXcd c;
  transform.coefficients(rest.data(), c);
  for (int k = 1; k <= count; ++k)
  {
    const std::complex<double> at_zero = c[k * ratio] * std::polar(1., -2. * M_PI * std::fmod(k * ratio * begin, 1.));
    result.amplitude.push_back(2. * std::abs(at_zero));
    result.phase.push_back(std::arg(at_zero));
  }
  return result;
}

SignalExtremes signal_extremes(const std::vector<double> &samples)
{
  const auto   n    = std::ptrdiff_t(samples.size()) - 1;
  const double ramp = samples.back() - samples.front();
  const auto   at   = [&](std::ptrdiff_t i)
  {
    return i < 0   ? samples[std::size_t(i + n)] - ramp
           : i > n ? samples[std::size_t(i - n)] + ramp
                   : samples[std::size_t(i)];
  };
  const auto about = [&](std::ptrdiff_t i) { return vertex(at(i - 2), at(i - 1), at(i), at(i + 1), at(i + 2)); };
  const auto high  = std::max_element(samples.begin(), samples.end()) - samples.begin(),
             low   = std::min_element(samples.begin(), samples.end()) - samples.begin();
  return {std::min(at(low), about(low)), std::max(at(high), about(high))};
}

} // namespace gestell::coupling
