// Amplitudes and phases of sampled signals.

#include "coupling/periodic/harmonic/signal_harmonics.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr double T = 0.3, t_0 = 0.7, mean = 2.5, turn = 2. * M_PI;
constexpr int    N = 128, ratio = 3;

/// A ramp, a mean, two harmonics of the drive and one of the motion alone, which repeats after three periods of it.
std::vector<double> signal()
{
  const double        Omega = ratio * 2. * M_PI / T;
  std::vector<double> x;
  for (int i = 0; i <= N; ++i)
  {
    const double t = t_0 + T * i / N;
    x.push_back(mean + turn * i / N + 0.4 * std::cos(Omega * t + 1.2) + 1e-6 * std::cos(4. * Omega * t - 2.9) +
                7. * std::cos(Omega / 3. * t));
  }
  return x;
}

} // namespace

/// A sum of harmonics below N/2 is told to rounding, N eps of the largest value.
TEST(SignalHarmonics, AreThoseOfASumOfHarmonics)
{
  const coupling::SignalHarmonics found   = coupling::signal_harmonics(signal(), t_0 / T, ratio, 5);
  const double                    rounded = N * 2.3e-16 * 16.;
  EXPECT_NEAR(found.ramp, turn, rounded);
  EXPECT_NEAR(found.mean, mean + turn * (N - 1) / (2. * N), rounded);
  const double amplitude[] = {0.4, 0., 0., 1e-6, 0.};
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(found.amplitude[k], amplitude[k], rounded) << k;
  EXPECT_NEAR(found.phase[0], 1.2, rounded / 0.4);
  EXPECT_NEAR(found.phase[3], -2.9, rounded / 1e-6);
}

TEST(SignalHarmonics, AreRefusedWhereSamplesCannotTellThem)
{
  expect_refusal([] { coupling::signal_harmonics(signal(), 0., ratio, 22); }, "132");
  expect_refusal([] { coupling::signal_harmonics(std::vector<double>(71, 0.), 0., 1, 5); }, "multiple of 4");
}

/// Parabolas through samples h apart err by h^4/64 of a cosine at most; |cos| has its kink at a sample, a ramp its
/// ends.
TEST(SignalExtremes, LieBetweenTheSamplesButNotAtKinksAndEnds)
{
  constexpr int       n = 256;
  const double        h = 2. * M_PI / n;
  std::vector<double> cosine, kink, ramp;
  for (int k = 0; k <= n; ++k)
  {
    const double t = h * k;
    cosine.push_back(std::cos(t - 0.3 * h));
    kink.push_back(std::abs(std::cos(t)));
    ramp.push_back(t + 0.1 * std::sin(t));
  }
  EXPECT_NEAR(coupling::signal_extremes(cosine).max, 1., std::pow(h, 4) / 64.);
  EXPECT_NEAR(coupling::signal_extremes(cosine).min, -1., std::pow(h, 4) / 64.);
  EXPECT_LT(*std::max_element(cosine.begin(), cosine.end()), 1. - 1e-5) << "samples alone miss it";
  EXPECT_NEAR(coupling::signal_extremes(kink).min, 0., 1e-15);
  EXPECT_EQ(coupling::signal_extremes(ramp).min, ramp.front());
  EXPECT_EQ(coupling::signal_extremes(ramp).max, ramp.back());
}

} // namespace gestell::tests
