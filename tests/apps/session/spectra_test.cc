#include "apps/session/spectra/spectra.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gestell;
using namespace gestell::apps;

/// A cosine whose frequency is a line has its amplitude there and half of it beside, by the window.
TEST(Spectra, OfACosineIsItsAmplitudeAndHalfOfItBeside)
{
  std::vector<double> y;
  for (int j = 0; j < 1024; ++j)
    y.push_back(5. + 3. * std::cos(2. * M_PI * 37. * j / 1024.));
  const std::vector<double> a = hann_amplitudes(y);
  ASSERT_EQ(a.size(), 513u);
  EXPECT_NEAR(a[37], 3., 1e-12);
  EXPECT_NEAR(a[36], 1.5, 1e-12);
  EXPECT_NEAR(a[38], 1.5, 1e-12);
  EXPECT_NEAR(a[0], 0., 1e-12);
  EXPECT_NEAR(a[100], 0., 1e-12);
}

/// Rows at unequal distances, two at an event: sampled anew on their straight lines.
TEST(Spectra, FindAFrequencyInAHistoryWithEvents)
{
  coupling::RunResult run;
  run.columns = {"t", "x", "F"};
  run.units   = {"s", "m", "N"};
  run.signals = {{"x", "m"}, {"F", "N"}};
  for (int i = 0; i <= 4000; ++i)
    for (int twice = 0; twice < (i == 1234 ? 2 : 1); ++twice)
    {
      const double t = 2. * (i + (i % 2 == 0 ? 0. : 0.2)) / 4000.;
      run.rows.insert(run.rows.end(), {t, 0., 100. * std::sin(2. * M_PI * 50. * t)});
    }
  const auto found = spectra(run);
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->signals.size(), 1u); // a force rather than a displacement
  EXPECT_NEAR(found->resolution_hz, 0.5, 1e-12);
  // Straight lines flatten a sine by (omega h)^2 / 12, some 0.1 %.
  EXPECT_NEAR(found->signals[0].amplitudes[100], 100., 0.3);
}

TEST(Spectra, OfAShortHistoryAreNone)
{
  coupling::RunResult run;
  run.columns = {"t", "F"};
  run.units   = {"s", "N"};
  run.signals = {{"F", "N"}};
  run.rows    = {0., 1., 1., 2.};
  EXPECT_FALSE(spectra(run).has_value());
  EXPECT_FALSE(spectra(coupling::RunResult()).has_value());
}
