// Orders of a rotor that runs up, of signals whose orders are known.

#include "apps/analysis/spectra/order_tracking.h"
#include "apps/analysis/spectra/waterfall.h"
#include "fem/values/two_pi.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::OrderTracking;
using apps::Scene;

/// A scene that tells a motion of its rotor "shaft" and a signal y.
Scene scene_with(const std::string &path)
{
  Scene             scene;
  apps::BodyRequest shaft;
  shaft.name    = "shaft";
  scene.bodies  = {shaft};
  scene.signals = {{"told", path, "", ""}, {"y", "block.ux", "", ""}};
  return scene;
}

/// Run-up phi = w0 t + a t^2/2 from 10 to 40 turns a second in 4 s: y = 7 + 0.5 cos phi + 3 sin(2 phi + 0.3).
coupling::RunResult run_up(bool tells_angle, double step, double sense = 1.)
{
  coupling::RunResult run;
  run.columns = {"t", "told", "y"};
  run.units   = {"s", tells_angle ? "rad" : "rad/s", "m"};
  for (int i = 0; i * step <= 4.; ++i)
  {
    const double t = i * step, w_0 = 10. * two_pi, a = 7.5 * two_pi, phi = w_0 * t + 0.5 * a * t * t;
    run.rows.insert(run.rows.end(), {t, sense * (tells_angle ? phi : w_0 + a * t),
                                     7. + 0.5 * std::cos(phi) + 3. * std::sin(2. * phi + 0.3)});
  }
  return run;
}

void expect_orders(const OrderTracking &tracking, double tolerance)
{
  ASSERT_EQ(tracking.signals.size(), 1u);
  ASSERT_GE(tracking.orders.size(), 3u);
  const auto &amplitudes = tracking.signals[0].amplitudes;
  for (std::size_t window = 0; window < tracking.t.size(); ++window)
    for (std::size_t k = 0; k < amplitudes.size(); ++k)
      EXPECT_NEAR(amplitudes[k][window], k == 0 ? 0.5 : k == 1 ? 3. : 0., tolerance) << "order " << k + 1;
}

} // namespace

TEST(OrderTracking, FindsTheAmplitudesOfARunUp)
{
  for (const double sense : {1., -1.})
  {
    const auto tracking = apps::order_tracking(scene_with("shaft.angle"), run_up(true, 2e-4, sense));
    ASSERT_TRUE(tracking);
    EXPECT_EQ(tracking->rotor, "shaft");
    // Cubics through rows of 2e-4 s: 3/128 (omega h)^4 of order 2 at 40 turns a second, 2e-6 of 3.
    expect_orders(*tracking, 1e-5);
    EXPECT_GT(tracking->speed_rpm.front(), 600.);
    EXPECT_LT(tracking->speed_rpm.back(), 2400.);
    EXPECT_GT(tracking->speed_rpm.back(), 2200.);
  }
}

TEST(OrderTracking, TakesASpeedForItsAngle)
{
  const auto tracking = apps::order_tracking(scene_with("shaft.speed"), run_up(false, 2e-4));
  ASSERT_TRUE(tracking);
  expect_orders(*tracking, 1e-5); // of a speed that is linear in time trapezoids are exact
}

TEST(OrderTracking, TellsNoMoreOrdersThanTheRowsResolve)
{
  // 125 rows a second at 40 turns a second: 3 of a turn, that is one order.
  const auto tracking = apps::order_tracking(scene_with("shaft.angle"), run_up(true, 0.008));
  ASSERT_TRUE(tracking);
  EXPECT_EQ(tracking->orders.size(), 1u);
  EXPECT_FALSE(apps::order_tracking(scene_with("shaft.angle"), run_up(true, 0.02)));
}

TEST(Waterfall, KeepsAVibrationOfItsOwnInPlaceWhileOrdersMove)
{
  // From 10 to 40 turns a second in 4 s: 2 mm at 90 Hz whatever the speed, and 1 mm of order 1.
  apps::TurningHistory history;
  std::vector<double>  y;
  for (double t = 0.; t <= 4.; t += 1e-4)
  {
    const double phi = two_pi * (10. * t + 0.5 * 7.5 * t * t);
    history.t.push_back(t);
    history.speed_rpm.push_back(60. * (10. + 7.5 * t));
    y.push_back(2e-3 * std::sin(two_pi * 90. * t) + 1e-3 * std::cos(phi));
  }
  const apps::Waterfall spectra = apps::waterfall("y", "m", history, y, 120.);
  ASSERT_GT(spectra.speed_rpm.size(), 20u);
  const auto &f  = spectra.frequencies_hz;
  const auto  at = [&](double hz) { return std::size_t(std::lower_bound(f.begin(), f.end(), hz) - f.begin()); };
  for (std::size_t row = 0; row < spectra.speed_rpm.size(); ++row)
  {
    const auto  &amplitudes = spectra.amplitudes[row];
    const double own = *std::max_element(amplitudes.begin() + long(at(80.)), amplitudes.begin() + long(at(100.)));
    // Bins of 0.5 Hz, a window of 1/3 s: half a bin beside its middle Hann's window has lost 1 - (pi^2/6 - 1)(T/4)^2 =
    // 0.5 %.
    EXPECT_NEAR(own, 2e-3, 2e-5) << spectra.speed_rpm[row];
    const auto top = std::max_element(amplitudes.begin(), amplitudes.begin() + long(at(70.)));
    // The speed changes by 2.5 turns a second within a window.
    EXPECT_NEAR(f[std::size_t(top - amplitudes.begin())], spectra.speed_rpm[row] / 60., 1.) << row;
  }
}

/// A run-up from 10 to 40 turns a second in 4 s, and a vibration of amplitude 1 beside it.
apps::Waterfall of_vibration(double hz, double row_step, double highest)
{
  apps::TurningHistory history;
  std::vector<double>  y;
  for (double t = 0.; t <= 4.; t += row_step)
  {
    history.t.push_back(t);
    history.speed_rpm.push_back(60. * (10. + 7.5 * t));
    y.push_back(std::sin(two_pi * hz * t));
  }
  return apps::waterfall("y", "m", history, y, highest);
}

// Of 1024 samples in a window of 1/3 s, 3000 Hz would appear at 72 Hz.
TEST(Waterfall, DoesNotFoldDownWhatTheRowsTell)
{
  const apps::Waterfall spectra = of_vibration(3000., 1e-4, 120.);
  ASSERT_GT(spectra.amplitudes.size(), 20u);
  for (const auto &row : spectra.amplitudes)
    EXPECT_LT(*std::max_element(row.begin(), row.end()), 1e-3);
}

TEST(Waterfall, EndsBelowHalfTheRateOfRows)
{
  const apps::Waterfall spectra = of_vibration(30., 5e-3, 1000.);
  ASSERT_FALSE(spectra.frequencies_hz.empty());
  EXPECT_LT(spectra.frequencies_hz.back(), 100.);
}

TEST(OrderTracking, NeedsARotorThatTurns)
{
  EXPECT_FALSE(apps::order_tracking(scene_with("block.uz"), run_up(true, 1e-3)));
  EXPECT_FALSE(apps::order_tracking(scene_with("shaft.angle"), coupling::RunResult()));
  coupling::RunResult still = run_up(true, 1e-3);
  for (std::size_t i = 1; i < still.rows.size(); i += 3)
    still.rows[i] = 0.1 * std::sin(still.rows[i]);
  EXPECT_FALSE(apps::order_tracking(scene_with("shaft.angle"), still));
}

} // namespace gestell::tests
