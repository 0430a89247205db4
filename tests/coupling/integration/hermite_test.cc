// Interpolation of a motion between points of time.

#include "coupling/integration/system/hermite.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// x = 4 + 46 t + 300 t^2 - 5000 t^3 and its rate by 2 or 3 points that are h apart, in the middle of the first two.
std::pair<double, double> errors_of_cubic(int n, double h)
{
  const auto                    place = [](double t) { return 4. + t * (46. + t * (300. - t * 5000.)); };
  const auto                    speed = [](double t) { return 46. + t * (600. - t * 15000.); };
  std::array<double, 3>         t{}, x{}, v{};
  std::array<const double *, 3> x_i{}, v_i{};
  for (int i = 0; i < n; ++i)
  {
    t[i] = i * h, x[i] = place(t[i]), v[i] = speed(t[i]);
    x_i[i] = &x[i], v_i[i] = &v[i];
  }
  Eigen::VectorXd at(1), rate(1);
  coupling::interpolate_motion(coupling::hermite_weights(t.data(), n, 0.5 * h), x_i, v_i, at, rate);
  return {std::abs(at[0] - place(0.5 * h)), std::abs(rate[0] - speed(0.5 * h))};
}

// Two values and two rates determine a cubic; rounding of x, eps 4, counts in the rate by 3/h.
TEST(Hermite, OfACubicIsExactWithinRounding)
{
  for (const int n : {2, 3})
    for (const double h : {1e-1, 1e-3, 1e-5})
    {
      const auto [x, v] = errors_of_cubic(n, h);
      EXPECT_LT(x, 1e-14) << n << ' ' << h;
      EXPECT_LT(v, 1e-14 / h + 1e-13) << n << ' ' << h;
    }
}

// By the rates alone: h^2/8 v'', below rounding.
TEST(Hermite, TheRateOfAStepTooShortForDifferencesOfPlacesIsThatOfTheRates)
{
  for (const int n : {2, 3})
    for (const double h : {1e-9, 1e-11, 1e-13, 1e-15})
      EXPECT_LT(errors_of_cubic(n, h).second, 1e-13) << n << ' ' << h;
}

} // namespace
} // namespace gestell::tests
