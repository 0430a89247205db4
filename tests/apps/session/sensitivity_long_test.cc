// Derivatives of all shipped scenes, by entries drawn at random, against converged differences of runs.

#include "tests/apps/session/sensitivity_comparison.h"
#include "tests/support/test.h"

#include <cctype>

namespace gestell::tests
{
namespace
{

using OfShippedScenes = ::testing::TestWithParam<ComparedScene>;

TEST_P(OfShippedScenes, AreDifferencesOfConvergedRuns)
{
  const Comparison found = compared_with_differences(GetParam());
  EXPECT_GT(found.smooth.converged + found.events.converged, 20);
  EXPECT_TRUE(found.beyond.empty()) << found.beyond.front();
  EXPECT_TRUE(found.missing.empty()) << found.missing.front();
}

std::string name_of(const ::testing::TestParamInfo<ComparedScene> &info)
{
  std::string name = info.param.scene.substr(0, info.param.scene.find('.'));
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

/// Runs are shortened to a time after some events, by this tolerance.
ComparedScene until(const std::string &end, const std::string &tolerance, ComparedScene compared)
{
  compared.overrides.insert(compared.overrides.end(), {"run.tolerance=" + tolerance, "run.end=" + end});
  return compared;
}

/// Cranes whose limiter acts after 0.2 s, and so briskly that wheels leave the ground.
ComparedScene braked_early(const std::string &scene, const std::vector<std::string> &overrides)
{
  return until("0.6 s", "1e-10", {scene, overrides, 0.0002, 3, 4});
}

INSTANTIATE_TEST_SUITE_P(
    Long, OfShippedScenes,
    ::testing::Values(until("2 s", "1e-11", {"double_four_bar.toml", {}, 0.0001, 8, 6}),
                      until("4 s", "1e-11", {"crane_minimal.toml", {}, 0.0001, 8, 6}),
                      until("1 s", "1e-10", {"run_up.toml", {}, 0.0002, 4, 4}),
                      until("1 s", "1e-11", {"spatial_crank_rocker.toml", {}, 0.0002, 5, 4}),
                      until("0.1 s", "1e-10", {"offset_four_bar.toml", {}, 0.0002, 4, 4}),
                      until("0.9 s", "1e-11", {"geneva_drive.toml", {}, 0.0002, 5, 4}),
                      until("0.6 s", "1e-11", {"crank_press_joints.toml", {}, 0.0002, 5, 4}),
                      until("0.45 s", "1e-11", {"press_minimal_light.toml", {}, 0.0002, 5, 4}),
                      until("0.45 s", "1e-11", {"press_minimal.toml", {}, 0.0002, 5, 4}),
                      until("0.45 s", "1e-11", {"press_emergency_stop.toml", {}, 0.0002, 5, 4}),
                      until("3 s", "1e-10", {"press_strokes.toml", {}, 0.0002, 3, 4}),
                      until("0.8 s", "1e-10", {"cam_follower.toml", {}, 0.0002, 5, 4}),
                      until("4 s", "1e-11", {"crane_minimal_lift.toml", {}, 0.0002, 5, 4}),
                      until("4 s", "1e-11", {"crane_minimal_elastic.toml", {}, 0.0002, 4, 4}),
                      until("0.2 s", "1e-10", {"needle_bar.toml", {}, 0.0002, 3, 4}),
                      until("1.6 s", "1e-10", {"portal_slider_crank.toml", {}, 0.0002, 3, 4}),
                      until("0.2 s", "1e-10", {"ladder_chassis.toml", {}, 0.0002, 3, 4}),
                      until("0.45 s", "1e-10", {"press.toml", {}, 0.0002, 3, 4}),
                      until("0.45 s", "1e-10", {"tie_rod_press.toml", {}, 0.0002, 3, 4}),
                      braked_early("crane.toml", {"parameters.F_limit=252 kN", "parameters.v_cylinder=-0.15 m/s",
                                                  "parameters.T_brake=0.06 s"}),
                      braked_early("crane_slewed.toml", {"parameters.F_limit=252 kN", "parameters.v_cylinder=-0.15 m/s",
                                                         "parameters.T_brake=0.06 s"}),
                      until("3.5 s", "1e-10", {"crane_emergency.toml", {}, 0.0002, 3, 4})),
    name_of);

} // namespace
} // namespace gestell::tests
