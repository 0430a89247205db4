// Derivatives of some shipped scenes, by entries drawn at random, against converged differences of runs; of all scenes:
// sensitivity_long_test.cc.

#include "tests/apps/session/sensitivity_comparison.h"

#include <gtest/gtest.h>

namespace gestell::tests
{
namespace
{

TEST(SensitivitiesOfShippedScenes, AreDifferencesOfConvergedRuns)
{
  // A mechanism with joints that is switched, a position function, and a play with a sheet that breaks.
  for (const auto &[scene, end] : {std::pair("crank_press_joints.toml", "0.6 s"),
                                   std::pair("geneva_drive.toml", "0.7 s"), std::pair("press_minimal.toml", "0.3 s")})
  {
    const Comparison found =
        compared_with_differences({scene, {"run.tolerance=1e-11", std::string("run.end=") + end}, 2e-4, 3, 4});
    EXPECT_GT(found.smooth.converged, 10) << scene;
    EXPECT_GT(found.events.converged, 10) << scene;
    EXPECT_TRUE(found.beyond.empty()) << found.beyond.front();
  }
}

} // namespace
} // namespace gestell::tests
