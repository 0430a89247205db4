#include "coupling/periodic/harmonic/signal_harmonics.h"

#include "coupling/periodic/harmonic/fourier_transform.h"

#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

SignalHarmonics signal_harmonics(const std::vector<double> &samples, double begin, int ratio, int count)
{
  const int n = int(samples.size()) - 1;
  if (2 * count * ratio >= n)
    throw std::invalid_argument("signal_harmonics: " + std::to_string(n) +
                                " samples of a period cannot tell harmonic " + std::to_string(count * ratio) +
                                " of it; give more than " + std::to_string(2 * count * ratio));
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

} // namespace gestell::coupling
