// Derivatives by all parameters of the light press and of the crane, against quotients of converged runs.

#include "apps/session/session.h"
#include "fem/values/number_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gestell::tests
{
namespace
{

using apps::Session;

/// Values of a run that are told as outputs with a derivative: extremes, final values, times of events.
std::vector<std::pair<std::string, double>> told(const apps::Result &result)
{
  std::vector<std::pair<std::string, double>> values;
  for (const auto &signal : result.run->signals)
    for (const auto &[name, value] :
         {std::pair(".min", signal.min), std::pair(".max", signal.max), std::pair(".final", signal.final)})
      values.emplace_back(signal.name + name, value);
  for (std::size_t i = 0; i < result.run->events.size(); ++i)
    values.emplace_back("events." + std::to_string(i + 1) + ".t", result.run->events[i].t);
  return values;
}

/// Relative differences of all derivatives from quotients of four runs, by all parameters.
std::vector<double> differences(const std::string &name, const std::vector<std::string> &overrides)
{
  constexpr double h     = 2e-4;
  const auto       path  = std::string(GESTELL_SOURCE_DIR "/apps/scenes/") + name;
  const auto       found = *Session(path, overrides).run("all").sensitivities;
  EXPECT_EQ(found.failure, "");
  std::vector<double> all;
  for (std::size_t k = 0; k < found.keys.size(); ++k)
  {
    const auto at = [&](double share)
    {
      auto more = overrides; // values in SI, read with their unit
      more.push_back(found.keys[k].key + "=" + exact_text(found.keys[k].value * (1. + share)) + " " +
                     found.keys[k].unit);
      return told(Session(path, more).run());
    };
    const auto near_below = at(-h), near_above = at(h), far_below = at(-2. * h), far_above = at(2. * h);
    for (const auto &output : found.outputs)
      for (std::size_t i = 0; i < near_below.size(); ++i)
        if (near_below[i].first == output.output && std::isfinite(output.derivative[Eigen::Index(k)]))
        {
          const double quotient =
              (8. * (near_above[i].second - near_below[i].second) - (far_above[i].second - far_below[i].second)) /
              (12. * h);
          all.push_back(std::abs(output.derivative[Eigen::Index(k)] * found.keys[k].value - quotient) /
                        std::max(std::abs(output.value), 1e-12));
        }
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(LongSensitivities, OfTheCraneByAllParametersAreQuotientsOfConvergedRuns)
{
  // Steps of 1 ms of order 4: of the largest load height, of which two peaks meet, the quotient is no derivative.
  const auto off = differences("crane_minimal.toml", {"run.order=4", "run.step=1 ms"});
  ASSERT_GT(off.size(), 200u);
  EXPECT_LT(off[off.size() / 2], 1e-6);
  EXPECT_LT(off[off.size() * 95 / 100], 2e-5);
}

TEST(LongSensitivities, OfTheLightPressByAllParametersAreQuotientsOfConvergedRuns)
{
  const auto off = differences("press_minimal_light.toml", {"run.tolerance=1e-11"});
  ASSERT_GT(off.size(), 1000u);
  EXPECT_LT(off[off.size() / 2], 1e-6);
  EXPECT_LT(off[off.size() * 95 / 100], 1e-4);
}

} // namespace
} // namespace gestell::tests
