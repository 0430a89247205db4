// Multipliers of small vibrations under a load that turns with its body: those of the linear machine, by every method.

#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/follower_plate.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gestell::tests
{
namespace
{

constexpr double Omega = 7.3;

/// The plate under a load so small that it stays linear: angles of 1e-4 change multipliers by their squares.
PeriodicResult vibrations(const std::string &method, double P)
{
  PeriodicRequest request;
  request.method = method;
  if (method == "shooting" || method == "collocation") // a flutter leaves the motion before
    request.own["lead-in"] = 0;
  return periodic_of(follower_plate(P, 2e-3) + cosine_load("plate", 0.05, Omega) +
                         test::quoted("[start]\nrule = 'static'\n[output.signals]\nx = 'plate.ux'\n"),
                     request);
}

} // namespace

TEST(FollowerOrbits, HaveTheMultipliersOfTheLinearMachine)
{
  for (const double P : {-200., -400.})
    for (const std::string method : {"shooting", "collocation", "harmonic-balance"})
    {
      const PeriodicResult result = vibrations(method, P);
      ASSERT_EQ(result.entries.size(), 1u) << method << result.failure;
      const auto &solution = result.entries[0].solution;
      EXPECT_EQ(solution.stable(), P > -300.) << method;
      for (const std::complex<double> &s : plate_roots(P, 2e-3))
      {
        const std::complex<double> expected = std::exp(s * 2. * M_PI / Omega);
        double                     nearest  = 1e9;
        for (const std::complex<double> &mu : solution.multipliers)
          nearest = std::min(nearest, std::abs(mu - expected));
        EXPECT_LT(nearest, 1e-6 * std::max(1., std::abs(expected))) << method << ' ' << P << ' ' << expected;
      }
    }
}

TEST(FollowerOrbits, AreNotAveraged)
{
  expect_refusal([] { vibrations("averaging", -200.); }, "follower forces");
}

} // namespace gestell::tests
