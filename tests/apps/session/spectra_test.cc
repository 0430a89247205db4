#include "apps/analysis/spectra/spectra.h"
#include "apps/output/report/section.h"
#include "apps/output/values/result.h"
#include "tests/support/test.h"

using namespace gestell;
using namespace gestell::apps;

/// A cosine whose frequency is a line has its amplitude there and half of it beside, by the window.
TEST(Spectra, OfACosineIsItsAmplitudeAndHalfOfItBeside)
{
  std::vector<double> y;
  for (int j = 0; j < 1024; ++j)
    y.push_back(5. + 3. * std::cos(2. * M_PI * 37. * j / 1024.));
  const std::vector<double> a = HannSpectrum(y.size()).amplitudes(y);
  ASSERT_EQ(a.size(), 513u);
  EXPECT_NEAR(a[37], 3., 1e-12);
  EXPECT_NEAR(a[36], 1.5, 1e-12);
  EXPECT_NEAR(a[38], 1.5, 1e-12);
  EXPECT_NEAR(a[0], 0., 1e-12);
  EXPECT_NEAR(a[100], 0., 1e-12);
}

/// At half the rate of samples lines from above and below are one.
TEST(Spectra, OfWhatTurnsItsSignFromRowToRowAreItsAmplitude)
{
  std::vector<double> y;
  for (int j = 0; j < 1024; ++j)
    y.push_back(j % 2 == 0 ? 3. : -3.);
  const std::vector<double> a = HannSpectrum(y.size()).amplitudes(y);
  EXPECT_NEAR(a[512], 3., 1e-12);
  EXPECT_NEAR(a[510], 0., 1e-12);
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
  const auto found = spectra(run, run.from);
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->signals.size(), 1u); // a force rather than a displacement
  EXPECT_NEAR(found->resolution_hz, 0.5, 1e-12);
  // Straight lines flatten a sine by (omega h)^2 / 12, some 0.1 %.
  EXPECT_NEAR(found->signals[0].amplitudes[100], 100., 0.3);
}

namespace
{

/// Rows of 100 N sin(2 pi f t) at distances h.
coupling::RunResult sine(double f, double h, int rows)
{
  coupling::RunResult run;
  run.columns = {"t", "F"};
  run.units   = {"s", "N"};
  run.signals = {{"F", "N"}};
  for (int i = 0; i < rows; ++i)
    run.rows.insert(run.rows.end(), {h * i, 100. * std::sin(2. * M_PI * f * h * i)});
  return run;
}

std::size_t highest_line(const std::vector<double> &amplitudes)
{
  return std::size_t(std::max_element(amplitudes.begin(), amplitudes.end()) - amplitudes.begin());
}

} // namespace

/// Rows at equal distances are not sampled anew: up to their half rate a sine has its line and its amplitude.
TEST(Spectra, OfEvenRowsReachToHalfTheirRate)
{
  const auto found = spectra(sine(400., 1e-3, 1001), 0.);
  ASSERT_TRUE(found.has_value());
  const std::vector<double> &a    = found->signals[0].amplitudes;
  const std::size_t          line = highest_line(a);
  EXPECT_NEAR(double(line) * found->resolution_hz, 400., 1e-6);
  EXPECT_NEAR(a[line], 100., 1e-6);
  EXPECT_NEAR(found->carried_hz, 500., 1e-6);
  EXPECT_EQ(a.size(), 501u);
  EXPECT_LT(*std::max_element(a.begin(), a.begin() + 398), 1e-6); // nothing folds
}

/// The window gives up rows at the end rather than a fast transform, here of 2003, a prime.  The sine then stands
/// between two lines, where the window leaves 85 % at least.
TEST(Spectra, OfAPrimeNumberOfRowsFindTheFrequency)
{
  const auto found = spectra(sine(400., 1e-3, 2004), 0.);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(found->samples, 1983);
  const std::vector<double> &a = found->signals[0].amplitudes;
  EXPECT_NEAR(double(highest_line(a)) * found->resolution_hz, 400., found->resolution_hz);
  EXPECT_GT(a[highest_line(a)], 84.8);
}

/// 8192 lines of 10 s end at 819 Hz; what swings above is left out, not folded.
TEST(Spectra, LeaveOutWhatIsAboveTheLastLine)
{
  const auto found = spectra(sine(1300., 1. / 4000., 40001), 0.);
  ASSERT_TRUE(found.has_value());
  const std::vector<double> &a = found->signals[0].amplitudes;
  EXPECT_EQ(a.size(), 8193u);
  EXPECT_NEAR(found->carried_hz, 2000., 1e-6);
  EXPECT_LT(*std::max_element(a.begin(), a.end()), 1.); // 1 % of its amplitude
}

/// Straight lines have images beyond half the rate, which come near from a quarter on.
TEST(Spectra, OfUnevenRowsEndAtAQuarterOfTheirRate)
{
  coupling::RunResult run = sine(100., 1e-3, 1001);
  for (std::size_t i = 2; i + 2 < run.rows.size(); i += 4)
    run.rows[i] += 1e-4;
  const auto found = spectra(run, run.from);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->carried_hz, 250., 1e-6);
  EXPECT_NEAR(double(found->signals[0].amplitudes.size() - 1) * found->resolution_hz, 250., found->resolution_hz);
}

TEST(Spectra, OfAShortHistoryAreNone)
{
  coupling::RunResult run;
  run.columns = {"t", "F"};
  run.units   = {"s", "N"};
  run.signals = {{"F", "N"}};
  run.rows    = {0., 1., 1., 2.};
  EXPECT_FALSE(spectra(run, run.from).has_value());
  EXPECT_FALSE(spectra(coupling::RunResult(), 0.).has_value());
}

/// 1 N at line 10 and `second` at line 60: 99 % of the power end at the first or at the second.
TEST(Spectra, AreDrawnUpTo99PercentOfTheirPower)
{
  for (const auto &[second, end] : {std::pair(0.1, 10.), {0.101, 60.}})
  {
    RunSpectra found;
    found.spectra = Spectra{0., 2., 400, 0.5, 5e-3, 100., {{"F", "N", std::vector<double>(201, 0.)}}};
    found.spectra->signals[0].amplitudes[10] = 1.;
    found.spectra->signals[0].amplitudes[60] = second;
    const Section section                    = spectrum_section(Result(), found);
    const auto   &drawing                    = std::get<Section::Drawing>(section.parts.back());
    EXPECT_EQ(drawing.chart.x.end, 0.5 * end);
    EXPECT_NE(drawing.chart.note.find("99 % of the power"), std::string::npos) << drawing.chart.note;
  }
}
